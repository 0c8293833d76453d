#include "sdf_ccd/dynamics/simulation_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "scene_shape.h"

namespace sdf_ccd {
namespace {

ContactOptions readContact(YamlMap contact) {
  ContactOptions options;
  options.stiffness = contact.get("stiffness", options.stiffness);
  options.damping = contact.get("damping", options.damping);
  options.midpoint_intervals = contact.get("midpoint_intervals", options.midpoint_intervals);
  const auto choose = [&](const std::string& key, const std::string& first, const std::string& second) {
    const auto chosen = contact.get(key, first);
    if (chosen != first && chosen != second) {
      contact.fail(contact.node(key), "`" + key + "`: " + first + " or " + second + " is wanted, got " + chosen);
    }
    return chosen == first;
  };
  options.stiffness_per = choose("stiffness_per", "area", "point") ? StiffnessPer::kArea : StiffnessPer::kPoint;
  options.normal = choose("normal", "field", "shell") ? NormalSource::kField : NormalSource::kShell;
  options.quadrature = choose("quadrature", "exact", "midpoint") ? Quadrature::kExact : Quadrature::kMidpoint;
  contact.finish();
  return options;
}

/// A copy of a body, as `repeat` asks for it.
struct Copy {
  std::string suffix;
  Vector3d offset = Vector3d::Zero();
  Quaterniond turn = Quaterniond::Identity();
};

std::vector<Copy> readCopies(YamlMap& body) {
  if (!body.has("repeat")) return {Copy{}};
  YamlMap repeat(body.node("repeat"), "repeat");
  const Vector3d count = repeat.vector("count"), spacing = repeat.vector("spacing");
  const double jitter = repeat.get("jitter", 0.0);
  const bool tumble = repeat.get("tumble", false);
  std::mt19937_64 random(repeat.get("seed", 1));
  repeat.finish();
  if (!(count.minCoeff() >= 1.0) || !(count.maxCoeff() <= 1000.0)) {
    repeat.fail(body.node("repeat"), "`count`: 1 to 1000 per axis");
  }
  const auto uniform = [&] { return 2.0 * (double(random() >> 11) * 0x1.0p-53) - 1.0; };
  std::vector<Copy> copies;
  for (int z = 0; z < int(count.z()); ++z) {
    for (int y = 0; y < int(count.y()); ++y) {
      for (int x = 0; x < int(count.x()); ++x) {
        Copy copy;
        copy.suffix = "/" + std::to_string(copies.size());
        copy.offset = spacing.cwiseProduct(Vector3d(x, y, z)) + jitter * Vector3d(uniform(), uniform(), uniform());
        if (tumble) copy.turn = Quaterniond(uniform() + 1.5, uniform(), uniform(), uniform()).normalized();
        copies.push_back(copy);
      }
    }
  }
  return copies;
}

/// Mass, and moments of inertia either given or of the shape at that mass.
void readMass(YamlMap& entry, const SceneShape& shape, RigidBody& body) {
  const double density = entry.get("density", 1000.0);
  if (shape.unit) {
    body.mass = entry.get("mass", density * shape.unit->mass);
    body.inertia = body.mass / shape.unit->mass * shape.unit->inertia;
  } else if (!body.fixed) {
    if (!entry.has("mass") || !entry.has("inertia")) {
      throw SimulationError(body.name, 0, "its shape encloses no volume; give mass and inertia");
    }
    body.mass = entry.get<double>("mass");
  }
  if (entry.has("inertia")) body.inertia = entry.vector("inertia").asDiagonal();
}

void readBody(YamlMap entry, const std::map<std::string, SceneShape>& shapes, SimulationSetup& setup) {
  RigidBody body;
  body.name = entry.get<std::string>("name");
  const auto shape_name = entry.get<std::string>("shape");
  const auto found = shapes.find(shape_name);
  if (found == shapes.end()) entry.fail(entry.node("shape"), "there is no shape `" + shape_name + "`");
  const SceneShape& shape = found->second;
  body.shape = shape.collision;
  body.fixed = entry.get("fixed", false);
  readMass(entry, shape, body);
  body.applied = {entry.vector("force", Vector3d::Zero()), entry.vector("torque", Vector3d::Zero())};
  const Vector3d xyz = entry.vector("xyz", Vector3d::Zero()), rpy = entry.vector("rpy", Vector3d::Zero());
  BodyState state;
  state.velocity = entry.vector("velocity", Vector3d::Zero());
  const Vector3d spin = entry.vector("spin", Vector3d::Zero());
  const Quaterniond turn = Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                           Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX());
  const std::string name = body.name;
  for (const Copy& copy : readCopies(entry)) {
    body.name = name + copy.suffix;
    state.X_OB.linear() = (turn * copy.turn).toRotationMatrix();
    state.X_OB.translation() = xyz + copy.offset + state.X_OB.linear() * shape.center;
    state.spin_B = state.X_OB.linear().transpose() * spin;
    setup.world.bodies.push_back(body);
    setup.states.push_back(state);
    setup.meshes.push_back(shape.mesh_B);
  }
  entry.finish();
}

void moveOriginNearBodies(SimulationSetup& setup) {
  for (std::size_t b = 0; b < setup.states.size(); ++b) {
    if (setup.world.bodies[b].fixed) continue;
    const Vector3d place = setup.states[b].X_OB.translation();
    if (!(place.norm() > 100.0) || !place.allFinite()) return;
    const Vector3d shift = place.array().round();
    setup.world.origin_W += shift;
    for (BodyState& state : setup.states) state.X_OB.translation() -= shift;
    return;
  }
}

}  // namespace

SimulationSetup parseSimulation(const std::string& text, const std::string& directory) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(error.what());
  }
  YamlMap scene(root, "scene");
  SimulationSetup setup;
  setup.scheme = schemeOf(scene.get<std::string>("integrator", toString(setup.scheme)));
  setup.step = scene.get<double>("step");
  setup.duration = scene.get<double>("duration");
  setup.world.gravity = scene.vector("gravity", setup.world.gravity);
  setup.world.origin_W = scene.vector("origin", Vector3d::Zero());
  setup.world.chord_tolerance = scene.get("chord_tolerance", setup.world.chord_tolerance);
  if (scene.has("contact")) setup.world.contact = readContact(YamlMap(scene.node("contact"), "contact"));
  std::map<std::string, SceneShape> shapes;
  for (const auto& entry : scene.node("shapes")) {
    const auto name = entry.first.as<std::string>();
    try {
      shapes[name] = buildSceneShape(YamlMap(entry.second, "shape `" + name + "`"), directory);
    } catch (const std::logic_error& error) {
      throw std::runtime_error("shape `" + name + "`: " + error.what());
    }
  }
  for (const YAML::Node& entry : scene.node("bodies")) readBody(YamlMap(entry, "body"), shapes, setup);
  scene.finish();
  moveOriginNearBodies(setup);
  return setup;
}

SimulationSetup loadSimulation(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw std::runtime_error(path + ": cannot be read");
  const std::string directory = std::filesystem::path(path).parent_path().string();
  try {
    return parseSimulation(text, directory.empty() ? "." : directory);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace sdf_ccd
