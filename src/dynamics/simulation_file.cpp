#include "sdf_ccd/dynamics/simulation.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "common/number_text.h"
#include "common/text_limits.h"
#include "rigid_motion.h"
#include "scene_shape.h"
#include "storage/regular_file.h"
#include "yaml/load_yaml.h"

namespace sdf_ccd {
namespace {

ContactOptions readContact(YamlMap contact) {
  ContactOptions options;
  options.stiffness = contact.get("stiffness", options.stiffness);
  options.damping = contact.get("damping", options.damping);
  options.midpoint_intervals = contact.count("midpoint_intervals", options.midpoint_intervals, 1, 10000);
  const auto is_first = [&](const std::string& key, const std::string& first, const std::string& second) {
    return contact.choice(key, {first, second}, first) == 0;
  };
  options.stiffness_per = is_first("stiffness_per", "area", "point") ? StiffnessPer::kArea : StiffnessPer::kPoint;
  options.normal = is_first("normal", "field", "shell") ? NormalSource::kField : NormalSource::kShell;
  options.quadrature = is_first("quadrature", "exact", "midpoint") ? Quadrature::kExact : Quadrature::kMidpoint;
  contact.finish();
  return options;
}

constexpr std::size_t kMaxBodies = 5000;  // all their pairs are stored, and tested in every step

/// A copy of a body, as given by `repeat`.
struct Copy {
  std::string suffix;
  Vector3d offset = Vector3d::Zero();
  Quaterniond rotation = Quaterniond::Identity();
};

std::vector<Copy> readCopies(YamlMap& body) {
  if (!body.has("repeat")) return {Copy{}};
  YamlMap repeat(body.node("repeat"), "repeat");
  const Vector3d count = repeat.vector("count"), spacing = repeat.vector("spacing");
  const double jitter = repeat.get("jitter", 0.0);
  const bool tumble = repeat.get("tumble", false);
  std::mt19937_64 random(repeat.get("seed", 1));
  repeat.finish();
  if (!(count.minCoeff() >= 1.0) || !(count.prod() <= double(kMaxBodies)) || count != count.array().round().matrix()) {
    repeat.fail(repeat.node("count"), "`count`: whole numbers from 1, together at most " + std::to_string(kMaxBodies));
  }
  const auto uniform = [&] { return 2.0 * (double(random() >> 11) * 0x1.0p-53) - 1.0; };
  std::vector<Copy> copies;
  for (int z = 0; z < int(count.z()); ++z) {
    for (int y = 0; y < int(count.y()); ++y) {
      for (int x = 0; x < int(count.x()); ++x) {
        Copy copy;
        copy.suffix = "/" + std::to_string(copies.size());
        copy.offset = spacing.cwiseProduct(Vector3d(x, y, z)) + jitter * Vector3d(uniform(), uniform(), uniform());
        if (tumble) copy.rotation = Quaterniond(uniform() + 1.5, uniform(), uniform(), uniform()).normalized();
        copies.push_back(copy);
      }
    }
  }
  return copies;
}

/// Names are used in tf frames and in rows of CSV files.
void requireName(const YamlMap& entry, const YAML::Node& at, const std::string& name) {
  if (name.empty() || name.front() == '/' || name.find_first_of(",\"\r\n") != std::string::npos) {
    entry.fail(at, "`name` may not be empty, begin with a slash, or hold a comma, a quote or a line break");
  }
  if (name == "world" || name == "scene") entry.fail(at, "`name`: " + name + " is the name of a frame already");
}

/// Mass, and moments of inertia either given or of the shape at that mass.
void readMass(YamlMap& entry, const SceneShape& shape, RigidBody& body) {
  if (entry.has("mass") && entry.has("density")) entry.fail(entry.node("mass"), "`mass` or `density`, not both");
  const double density = entry.get("density", 1000.0);
  if (shape.unit) {
    body.mass = entry.get("mass", density * shape.unit->mass);
    body.inertia = body.mass / shape.unit->mass * shape.unit->inertia;
  } else if (!body.fixed) {
    if (!entry.has("mass") || !entry.has("inertia")) {
      throw SimulationError(body.name, 0,
                            shape.doubt.empty() ? "its shape encloses no volume; give mass and inertia"
                                                : "its shape is not closed (" + shape.doubt +
                                                      "); give mass, and inertia about the shape's origin");
    }
    body.mass = entry.get<double>("mass");
  }
  if (entry.has("inertia")) body.inertia = entry.vector("inertia").asDiagonal();
}

using Shapes = std::map<std::string, SceneShape>;

void readBody(YamlMap entry, const Shapes& shapes, std::set<std::string>& names, SimulationSetup& setup) {
  RigidBody body;
  body.name = entry.get<std::string>("name");
  requireName(entry, entry.node("name"), body.name);
  const auto shape_name = entry.get<std::string>("shape");
  const auto found = shapes.find(shape_name);
  if (found == shapes.end()) entry.fail(entry.node("shape"), "there is no shape `" + shape_name + "`");
  const SceneShape& shape = found->second;
  if (!shape.doubt.empty()) {
    setup.warnings.push_back("body `" + body.name + "`: its inside is ambiguous: " + shape.doubt);
  }
  body.shape = shape.collision;
  body.fixed = entry.get("fixed", false);
  readMass(entry, shape, body);
  body.applied = {entry.vector("force", Vector3d::Zero()), entry.vector("torque", Vector3d::Zero())};
  const Vector3d xyz = entry.vector("xyz", Vector3d::Zero()), rpy = entry.vector("rpy", Vector3d::Zero());
  BodyState state;
  state.velocity = entry.vector("velocity", Vector3d::Zero());
  const Vector3d spin = entry.vector("spin", Vector3d::Zero());
  const Quaterniond rotation = Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                               Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX());
  const std::string name = body.name;
  for (const Copy& copy : readCopies(entry)) {
    if (setup.world.bodies.size() == kMaxBodies) {
      entry.fail(entry.node("name"), "there are more than " + std::to_string(kMaxBodies) + " bodies");
    }
    body.name = name + copy.suffix;
    if (!names.insert(body.name).second) entry.fail(entry.node("name"), "there are two bodies `" + body.name + "`");
    state.X_OB.linear() = (rotation * copy.rotation).toRotationMatrix();
    state.X_OB.translation() = xyz + copy.offset + state.X_OB.linear() * shape.center;
    if (const double distance = state.X_OB.translation().norm(); !(distance <= kMaxDistance)) {
      entry.fail(entry.node("xyz"), "`xyz`: body `" + body.name + "` is " + numberText(distance) +
                                        " m from the scene's origin, at most " + numberText(kMaxDistance) +
                                        " m can be computed");
    }
    state.spin_B = state.X_OB.linear().transpose() * spin;
    setup.world.bodies.push_back(body);
    setup.states.push_back(state);
    setup.meshes.push_back(shape.mesh_B);
  }
  entry.finish();
}

Shapes readShapes(const YAML::Node& node, const std::string& directory) {
  const YamlMap map(node, "shapes");  // rejects anything but a map
  Shapes shapes;
  for (const auto& entry : node) {
    const std::string name = entry.first.Scalar(), what = "shape `" + name + "`";
    try {
      shapes[name] = buildSceneShape(YamlMap(entry.second, what), directory);
    } catch (const std::logic_error& error) {
      map.fail(entry.first, what + ": " + error.what());
    }
  }
  return shapes;
}

void moveOriginNearBodies(SimulationSetup& setup) {
  for (std::size_t b = 0; b < setup.states.size(); ++b) {
    if (setup.world.bodies[b].fixed) continue;
    const Vector3d position = setup.states[b].X_OB.translation();
    if (!(position.norm() > 100.0) || !position.allFinite()) return;
    const Vector3d shift = position.array().round();
    setup.world.origin_W += shift;
    for (BodyState& state : setup.states) state.X_OB.translation() -= shift;
    return;
  }
}

}  // namespace

SimulationSetup parseSimulation(const std::string& text, const std::string& directory) {
  YamlMap scene(loadYaml(text), "scene");
  SimulationSetup setup;
  setup.scheme = schemeOf(scene.get<std::string>("integrator", toString(setup.scheme)));
  setup.step = scene.get<double>("step");
  setup.duration = scene.get<double>("duration");
  setup.world.gravity = scene.vector("gravity", setup.world.gravity);
  setup.world.origin_W = scene.vector("origin", Vector3d::Zero());
  setup.world.chord_tolerance = scene.get("chord_tolerance", setup.world.chord_tolerance);
  if (scene.has("contact")) setup.world.contact = readContact(YamlMap(scene.node("contact"), "contact"));
  const Shapes shapes = readShapes(scene.node("shapes"), directory);
  const YAML::Node bodies = scene.node("bodies");
  scene.finish();
  if (!bodies.IsSequence() || bodies.size() == 0) scene.fail(bodies, "`bodies`: expected a list of at least one body");
  std::set<std::string> names;
  for (const YAML::Node& entry : bodies) readBody(YamlMap(entry, "body"), shapes, names, setup);
  moveOriginNearBodies(setup);
  return setup;
}

SimulationSetup loadSimulation(const std::string& path) {
  const std::string directory = std::filesystem::path(path).parent_path().string();
  try {
    return parseSimulation(readRegularFile(path, kMaxYamlBytes), directory.empty() ? "." : directory);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace sdf_ccd
