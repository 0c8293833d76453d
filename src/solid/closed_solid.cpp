#include "solid/closed_solid.h"

#include <algorithm>
#include <utility>

#include "conforming_mesh.h"

namespace sdf_ccd {

ClosedSolid::ClosedSolid(std::shared_ptr<const Solid> solid) : solid_(std::move(solid)) {
  if (solid_->closed()) return;
  ConformingMesh joined = conformingMesh(welded(solid_->boundary()));
  if (isClosed(joined.mesh)) {
    moved_ = joined.moved;
    solid_ = std::make_shared<const Solid>(std::move(joined.mesh));
    return;
  }
  openings_ = findOpenings(solid_->boundary());
  if (openings_.reach.empty()) return;
  solid_ = std::make_shared<const Solid>(welded(merged(solid_->boundary(), openings_.caps)));
}

bool ClosedSolid::hasCracksAlone() const {
  constexpr double kWidest = 2.5e-4;  // [m]
  return std::all_of(openings_.reach.begin(), openings_.reach.end(), [](double reach) { return reach <= kWidest; });
}

const Solid& SolidSource::solid() const {
  if (!made_->solid) made_->solid = std::make_shared<const Solid>(mesh_);
  return *made_->solid;
}

const std::shared_ptr<const VoxelSolid>& SolidSource::voxels() const {
  if (!made_->voxels) made_->voxels = made_->may_be_voxels ? VoxelSolid::of(mesh_) : nullptr;
  return *made_->voxels;
}

const ClosedSolid& SolidSource::closed() const {
  solid();
  if (!made_->closed) made_->closed = std::make_shared<const ClosedSolid>(made_->solid);
  return *made_->closed;
}

}  // namespace sdf_ccd
