#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/mesh/primitive.h"
#include "sdf_ccd/mesh/triangle_mesh.h"

namespace sdf_ccd {

/// A mesh in a file.
struct MeshObject {
  std::string uri;                    ///< as loadLocalResource() reads it
  Vector3d scale = Vector3d::Ones();  ///< along the file's axes; none of them 0
};

/// The occupied voxels of an OctoMap in a file, as parseOctomapSurface() reads it; the only shape of its object.
struct OctomapObject {
  std::string uri;         ///< as loadLocalResource() reads it
  double cell_size = 0.0;  ///< of its field [m]; 0: half a voxel
};

/// One shape of an object.
struct WorldShape {
  /// A mesh may also be one in memory.
  using Shape = std::variant<Primitive, MeshObject, OctomapObject, std::shared_ptr<const TriangleMesh>>;
  Shape shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< in the object's frame B
};

/// An object that a robot may hit, or carries.
struct WorldObject {
  std::string name;
  std::string frame;  ///< that carries it; empty: it does not move in the world
  Isometry3d X_frame_B = Isometry3d::Identity();
  std::vector<WorldShape> shapes;  ///< one or more
};

}  // namespace sdf_ccd
