#include "scene_shape.h"

#include <optional>

#include "dynamics/collision_shape.h"
#include "dynamics/scene_settings.h"
#include "mesh/generated_mesh.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

Thread readThread(SettingsReader& shape) {
  return {shape.number("radius"), shape.number("pitch"), shape.number("depth")};
}

/// Number of points around the axis.
int readSteps(SettingsReader& shape, int otherwise) {
  return shape.integer("steps", otherwise, 3, 1000);
}

std::optional<TriangleMesh> readMesh(SettingsReader& shape, const std::string& type, const std::string& directory) {
  const auto length = [&](const char* key) { return shape.number(key); };
  if (type == "mesh") {
    const std::string file = shape.text("file");
    const bool absolute = !file.empty() && file.front() == '/';
    return scaled(loadMesh(absolute ? file : directory + "/" + file), Vector3d::Constant(shape.number("scale", 1.0)));
  }
  if (type == "bowl") return bowlMesh(length("radius"), length("thickness"), readSteps(shape, 64));
  if (type == "blob")
    return blobMesh(length("radius"), shape.number("bump", 0.2), shape.integer("points", 800, 4, 1'000'000));
  if (type == "top") return topMesh(length("radius"), length("height"), readSteps(shape, 48));
  if (type == "wedge") return wedgeMesh(length("width"), length("height"), length("length"));
  if (type == "slot") return slotMesh(length("width"), length("height"), length("length"));
  if (type == "bolt") return boltMesh(readThread(shape), length("length"), readSteps(shape, 64));
  if (type == "nut") {
    const Thread thread = readThread(shape);
    return nutMesh(thread, length("clearance"), length("height"), readSteps(shape, 64));
  }
  return std::nullopt;
}

/// Mass properties at 1 kg/m³; empty if the geometry has none, because a fixed body needs none.
template <class Geometry>
std::optional<MassProperties> unitMass(const Geometry& geometry) {
  try {
    return massProperties(geometry, 1.0);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Replaces the hierarchy by a single sphere around all points, for comparison (paper Tables 3 and 4).
void flatten(CollisionShape& shape) {
  if (shape.tree.nodes.empty()) return;
  SphereTree::Node root = shape.tree.nodes.front();
  root.first_child = -1;
  shape.tree.nodes = {root};
}

}  // namespace

SceneShape buildSceneShape(SettingsReader shape, const std::string& directory) {
  const std::string type = shape.text("type");
  const bool linear = shape.choice("traversal", {"hierarchy", "linear"}, 0) == 1;
  SceneShape built;
  CollisionShape collision;
  ShellOptions shell;
  if (const std::optional<Primitive> primitive = readPrimitive(shape, type)) {
    const AlignedBox3d box = boundingBox(*primitive);
    const bool bounded = box.sizes().allFinite();
    built.unit = unitMass(*primitive);
    shell.spacing = shape.positive("spacing", bounded ? box.sizes().maxCoeff() / 20.0 : 1.0);
    if (bounded) {
      built.mesh_B = std::make_shared<TriangleMesh>(tessellate(*primitive, box.sizes().maxCoeff() / 200.0));
    }
    collision = *makeShape(*primitive, shell);
  } else {
    const std::optional<TriangleMesh> drawn = readMesh(shape, type, directory);
    if (!drawn) shape.fail("type", "one of box sphere cylinder plane mesh bowl blob top wedge slot bolt nut");
    const OrientedMesh oriented = orientOutward(*drawn);
    const TriangleMesh& mesh = oriented.mesh;
    if (oriented.quality.sign_trusted)
      built.unit = unitMass(mesh);
    else
      built.doubt = summary(oriented.quality);
    if (built.unit) built.center = built.unit->center;
    built.mesh_B = std::make_shared<TriangleMesh>(transformed(mesh, Isometry3d(Eigen::Translation3d(-built.center))));
    const double side = boundingBox(mesh).sizes().maxCoeff();
    FieldOptions field;
    field.cells = shape.integer("cells", 64, 1);
    shell.spacing = shape.positive("spacing", side / 25.0);
    shell.vertex_spacing = shape.number("vertex_spacing", 0.5 * shell.spacing);
    collision = *makeShape(*built.mesh_B, field, shell);
  }
  if (linear) flatten(collision);
  shape.finish();
  built.collision = std::make_shared<CollisionShape>(std::move(collision));
  return built;
}

}  // namespace sdf_ccd
