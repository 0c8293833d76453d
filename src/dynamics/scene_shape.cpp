#include "scene_shape.h"

#include <map>

#include "geometry/generated_mesh.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/import/mesh_file.h"

namespace sdf_ccd {
namespace {

std::optional<Primitive> readPrimitive(YamlMap& shape, const std::string& type) {
  if (type == "sphere") return Sphere{shape.get<double>("radius")};
  if (type == "box") return Box{0.5 * shape.vector("size")};
  if (type == "cylinder") return Cylinder{shape.get<double>("radius"), 0.5 * shape.get<double>("length")};
  if (type == "plane") return HalfSpace{Vector3d::UnitZ(), 0.0};
  return std::nullopt;
}

Thread readThread(YamlMap& shape) {
  return {shape.get<double>("radius"), shape.get<double>("pitch"), shape.get<double>("depth")};
}

/// Number of points around the axis.
int readSteps(YamlMap& shape, int otherwise) {
  return shape.count("steps", otherwise, 3, 1000);
}

using Maker = TriangleMesh (*)(YamlMap& shape, const std::string& directory);

const std::map<std::string, Maker>& meshMakers() {
  static const std::map<std::string, Maker> makers = {
      {"mesh",
       [](YamlMap& shape, const std::string& directory) {
         const auto file = shape.get<std::string>("file");
         const bool absolute = !file.empty() && file.front() == '/';
         return scaled(loadMesh(absolute ? file : directory + "/" + file), Vector3d::Constant(shape.get("scale", 1.0)));
       }},
      {"bowl",
       [](YamlMap& shape, const std::string&) {
         return bowlMesh(shape.get<double>("radius"), shape.get<double>("thickness"), readSteps(shape, 64));
       }},
      {"blob",
       [](YamlMap& shape, const std::string&) {
         return blobMesh(shape.get<double>("radius"), shape.get("bump", 0.2), shape.count("points", 800, 4, 1'000'000));
       }},
      {"top",
       [](YamlMap& shape, const std::string&) {
         return topMesh(shape.get<double>("radius"), shape.get<double>("height"), readSteps(shape, 48));
       }},
      {"wedge",
       [](YamlMap& shape, const std::string&) {
         return wedgeMesh(shape.get<double>("width"), shape.get<double>("height"), shape.get<double>("length"));
       }},
      {"slot",
       [](YamlMap& shape, const std::string&) {
         return slotMesh(shape.get<double>("width"), shape.get<double>("height"), shape.get<double>("length"));
       }},
      {"bolt",
       [](YamlMap& shape, const std::string&) {
         return boltMesh(readThread(shape), shape.get<double>("length"), readSteps(shape, 64));
       }},
      {"nut", [](YamlMap& shape, const std::string&) {
         const Thread thread = readThread(shape);
         return nutMesh(thread, shape.get<double>("clearance"), shape.get<double>("height"), readSteps(shape, 64));
       }}};
  return makers;
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
  root.child_count = 0;
  shape.tree.nodes = {root};
}

}  // namespace

SceneShape buildSceneShape(YamlMap shape, const std::string& directory) {
  const auto type = shape.get<std::string>("type");
  const bool linear = shape.choice("traversal", {"hierarchy", "linear"}, "hierarchy") == 1;
  SceneShape built;
  CollisionShape collision;
  ShellOptions shell;
  if (const std::optional<Primitive> primitive = readPrimitive(shape, type)) {
    validate(*primitive);
    const AlignedBox3d box = boundingBox(*primitive);
    const bool bounded = box.sizes().allFinite();
    built.unit = unitMass(*primitive);
    shell.spacing = shape.positive("spacing", bounded ? box.sizes().maxCoeff() / 20.0 : 1.0);
    if (bounded) {
      built.mesh_B = std::make_shared<TriangleMesh>(tessellate(*primitive, box.sizes().maxCoeff() / 200.0));
    }
    collision = makeShape(*primitive, shell);
  } else {
    const auto maker = meshMakers().find(type);
    if (maker == meshMakers().end()) shape.fail(shape.node("type"), "type `" + type + "` is not known");
    const OrientedMesh oriented = orientOutward(maker->second(shape, directory));
    const TriangleMesh& mesh = oriented.mesh;
    if (oriented.quality.sign_trusted)
      built.unit = unitMass(mesh);
    else
      built.doubt = summary(oriented.quality);
    if (built.unit) built.center = built.unit->center;
    built.mesh_B = std::make_shared<TriangleMesh>(transformed(mesh, Isometry3d(Eigen::Translation3d(-built.center))));
    const double side = boundingBox(mesh).sizes().maxCoeff();
    FieldOptions field;
    field.cells = shape.get("cells", 64);
    shell.spacing = shape.positive("spacing", side / 25.0);
    shell.vertex_spacing = shape.get("vertex_spacing", 0.5 * shell.spacing);
    collision = makeShape(*built.mesh_B, field, shell);
  }
  if (linear) flatten(collision);
  shape.finish();
  built.collision = std::make_shared<CollisionShape>(std::move(collision));
  return built;
}

}  // namespace sdf_ccd
