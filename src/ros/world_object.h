#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

struct MeshObject {
  std::string uri;
  Vector3d scale = Vector3d::Ones();
};

struct WorldShape {
  std::variant<Primitive, MeshObject, std::shared_ptr<const TriangleMesh>> shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< in the object's frame B
};

/// A static object of the world.
struct WorldObject {
  std::string name;
  std::string frame;  ///< empty: the fixed frame
  Isometry3d X_frame_B = Isometry3d::Identity();
  std::vector<WorldShape> shapes;  ///< one or more
};

}  // namespace sdf_ccd
