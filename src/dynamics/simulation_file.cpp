#include "sdf_ccd/simulation.h"

#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "common/files/regular_file.h"
#include "common/settings/yaml_settings.h"
#include "common/text_limits.h"
#include "dynamics/scene_settings.h"
#include "scene_shape.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxBodies = 5000;  // all their pairs are stored, and tested in every step

/// A copy of a body, as given by `repeat`.
struct Copy {
  std::string suffix;
  Vector3d offset = Vector3d::Zero();
  Quaterniond rotation = Quaterniond::Identity();
};

std::vector<Copy> readCopies(SettingsReader& body) {
  if (!body.has("repeat")) return {Copy{}};
  SettingsReader repeat = body.group("repeat");
  const Vector3d count = repeat.vector("count"), spacing = repeat.vector("spacing");
  const double jitter = repeat.number("jitter", 0.0);
  const bool tumble = repeat.flag("tumble", false);
  std::mt19937_64 random(repeat.integer("seed", 1, 0));
  repeat.finish();
  if (!(count.minCoeff() >= 1.0) || !(count.prod() <= double(kMaxBodies)) || count != count.array().round().matrix()) {
    repeat.fail("count", "whole numbers from 1, whose product is at most " + std::to_string(kMaxBodies));
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
std::string readName(SettingsReader& entry) {
  std::string name = entry.name("name");
  if (name.front() == '/' || name.find_first_of(",\"") != std::string::npos)
    entry.fail("name", "a name that does not begin with a slash, and holds no comma and no quote");
  if (name == "world" || name == "scene") entry.fail("name", "a name that no frame has already");
  return name;
}

/// Mass, and moments of inertia either given or of the shape at that mass.
void readMass(SettingsReader& entry, const SceneShape& shape, RigidBody& body) {
  if (entry.has("mass") && entry.has("density")) entry.fail("mass", "only one of mass and density to be set");
  const double density = entry.number("density", 1000.0);
  if (shape.unit) {
    body.mass = entry.number("mass", density * shape.unit->mass);
    body.inertia = body.mass / shape.unit->mass * shape.unit->inertia;
  } else if (!body.fixed) {
    if (!entry.has("mass") || !entry.has("inertia")) {
      throw SimulationError(body.name, 0,
                            shape.doubt.empty() ? "its shape encloses no volume; give mass and inertia"
                                                : "its shape is not closed (" + shape.doubt +
                                                      "); give mass, and inertia about the shape's origin");
    }
    body.mass = entry.number("mass");
  }
  if (entry.has("inertia")) body.inertia = entry.vector("inertia").asDiagonal();
}

using Shapes = std::map<std::string, SceneShape>;

void readBody(SettingsReader& entry, const Shapes& shapes, std::set<std::string>& names, SimulationSetup& setup) {
  RigidBody body;
  body.name = readName(entry);
  const auto found = shapes.find(entry.text("shape"));
  if (found == shapes.end()) entry.fail("shape", "the name of one of the shapes");
  const SceneShape& shape = found->second;
  if (!shape.doubt.empty()) {
    setup.warnings.push_back("body `" + body.name + "`: its inside is ambiguous: " + shape.doubt);
  }
  body.shape = shape.collision;
  body.fixed = entry.flag("fixed", false);
  readMass(entry, shape, body);
  body.applied = {entry.vector("force", Vector3d::Zero()), entry.vector("torque", Vector3d::Zero())};
  const Isometry3d X_OG = readPose(entry);
  BodyState state;
  state.velocity = entry.vector("velocity", Vector3d::Zero());
  const Vector3d spin = entry.vector("spin", Vector3d::Zero());
  const std::string name = body.name;
  for (const Copy& copy : readCopies(entry)) {
    if (setup.world.bodies.size() == kMaxBodies) {
      entry.fail("name", "at most " + std::to_string(kMaxBodies) + " bodies");
    }
    body.name = name + copy.suffix;
    if (!names.insert(body.name).second) entry.fail("name", "a name that no other body has");
    state.X_OB.linear() = X_OG.linear() * copy.rotation.toRotationMatrix();
    state.X_OB.translation() = X_OG.translation() + copy.offset + state.X_OB.linear() * shape.center;
    requireNear(entry, "repeat", state.X_OB.translation());
    state.spin_B = state.X_OB.linear().transpose() * spin;
    setup.world.bodies.push_back(body);
    setup.states.push_back(state);
    setup.meshes.push_back(shape.mesh_B);
  }
  entry.finish();
}

Shapes readShapes(SettingsReader group, const std::string& directory) {
  Shapes shapes;
  for (const std::string& name : group.keys()) {
    const SettingsReader shape = group.group(name);
    try {
      shapes[name] = buildSceneShape(shape, directory);
    } catch (const std::logic_error& error) {
      throw std::runtime_error(shape.name() + ": " + error.what());
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
  SettingsReader scene(parseYaml(text), "");
  SimulationSetup setup;
  setup.scheme = schemeOf(scene.text("integrator", toString(setup.scheme)));
  setup.step = scene.number("step");
  setup.duration = scene.number("duration");
  setup.world.gravity = scene.vector("gravity", setup.world.gravity);
  setup.world.origin_W = scene.vector("origin", Vector3d::Zero());
  setup.world.chord_tolerance = scene.number("chord_tolerance", setup.world.chord_tolerance);
  SettingsReader contact = scene.group("contact");
  setup.world.contact = readContact(contact);
  contact.finish();
  const Shapes shapes = readShapes(scene.group("shapes"), directory);
  std::vector<SettingsReader> bodies = scene.list("bodies");
  scene.finish();
  if (bodies.empty()) scene.fail("bodies", "a list of at least one body");
  std::set<std::string> names;
  for (SettingsReader& body : bodies) readBody(body, shapes, names, setup);
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
