#pragma once

#include <memory>
#include <optional>

#include "geometry/openings.h"
#include "geometry/solid_boundary.h"
#include "geometry/voxel_solid.h"

namespace sdf_ccd {

/// A solid; if it is not closed, joined where faces were tessellated apart (see conformingMesh()) if that closes it,
/// else with caps in its openings (see findOpenings()).
class ClosedSolid {
 public:
  explicit ClosedSolid(std::shared_ptr<const Solid> solid);

  const Solid& solid() const { return *solid_; }
  const Openings& openings() const { return openings_; }  ///< that were closed

 private:
  std::shared_ptr<const Solid> solid_;
  Openings openings_;
};

/// What a mesh was made into, each part when it was first asked for.
struct MadeSolid {
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ClosedSolid> closed;
  bool may_be_voxels = false;  ///< whether it is worth to look whether the mesh is a boundary of voxels
  std::optional<std::shared_ptr<const VoxelSolid>> voxels;
};

/// A mesh whose solid is made when it is first asked for, for what is mostly found in a cache.
class SolidSource {
 public:
  /// @param mesh  must outlive this.
  SolidSource(const TriangleMesh& mesh) : mesh_(mesh), made_(&own_) {}  // NOLINT: a mesh is enough for most
  /// @param made  what is kept for other sources. Must outlive this.
  SolidSource(const TriangleMesh& mesh, MadeSolid& made) : mesh_(mesh), made_(&made) {}
  SolidSource(const SolidSource&) = delete;
  SolidSource& operator=(const SolidSource&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  const Solid& solid() const;
  const ClosedSolid& closed() const;
  const VoxelSolid* voxels() const;  ///< null if it is none of voxels

 private:
  const TriangleMesh& mesh_;
  mutable MadeSolid own_;
  MadeSolid* made_;
};

}  // namespace sdf_ccd
