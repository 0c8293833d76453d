#pragma once

#include <memory>
#include <optional>

#include "mesh/voxel_solid.h"
#include "solid/openings/openings.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd {

/// A solid that is made closed if it is not. Faces that were tessellated separately are joined if that closes it (see
/// conformingMesh()); else caps are added in its openings (see findOpenings()).
class ClosedSolid {
 public:
  explicit ClosedSolid(std::shared_ptr<const Solid> solid);

  const Solid& solid() const { return *solid_; }
  const Openings& openings() const { return openings_; }  ///< those that were closed by caps
  double moved() const { return moved_; }                 ///< how far points of the surface were moved, at most [m]

  /// Whether the openings are cracks, so that nothing comes in through them: no point of a cap is farther from the mesh
  /// than a quarter of a millimetre.
  bool hasCracksAlone() const;

 private:
  std::shared_ptr<const Solid> solid_;
  Openings openings_;
  double moved_ = 0.0;
};

/// The solids made from a mesh, each when it was first requested.
struct MadeSolid {
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ClosedSolid> closed;
  bool may_be_voxels = false;  ///< whether to test if the mesh is the boundary of voxels
  std::optional<std::shared_ptr<const VoxelSolid>> voxels;
};

/// A mesh whose solid is made when it is first requested, as what is made from it is mostly found in a cache.
class SolidSource {
 public:
  /// @param mesh  must outlive this.
  SolidSource(const TriangleMesh& mesh) : mesh_(mesh), made_(&own_) {}  // NOLINT: a mesh is enough for most
  /// @param made  holds the solids, also for other sources. Must outlive this.
  SolidSource(const TriangleMesh& mesh, MadeSolid& made) : mesh_(mesh), made_(&made) {}
  SolidSource(const SolidSource&) = delete;
  SolidSource& operator=(const SolidSource&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  const Solid& solid() const;
  const ClosedSolid& closed() const;
  const std::shared_ptr<const VoxelSolid>& voxels() const;  ///< null if the mesh is not the boundary of voxels

 private:
  const TriangleMesh& mesh_;
  mutable MadeSolid own_;
  MadeSolid* made_;
};

}  // namespace sdf_ccd
