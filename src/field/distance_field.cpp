#include "sdf_ccd/field.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/infinity.h"
#include "common/number_text.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "field/uniform/sparse_grid.h"
#include "grid_sample.h"

namespace sdf_ccd {

namespace {

/// The sample at a point outside a grid. The distance is at least that to the surface's box, and at most the length of
/// the path through `boundary_F`, the nearest point of the grid's box.
FieldSample outsideSample(const AlignedBox3d& surface_box, const Vector3d& p_F, const Vector3d& boundary_F,
                          const FieldSample& at_boundary) {
  const double low = surface_box.exteriorDistance(p_F);
  const double high = std::max(low, (p_F - boundary_F).norm() + at_boundary.value + at_boundary.error);
  const Vector3d nearest = p_F.cwiseMax(surface_box.min()).cwiseMin(surface_box.max());
  return {0.5 * (low + high), 0.5 * (high - low), (p_F - nearest).normalized()};
}

void requireValid(const void* grid, double moved) {
  if (!grid) throw std::invalid_argument("distance field: no grid");
  if (moved >= 0.0 && std::isfinite(moved)) return;
  throw std::invalid_argument("distance field: the surface cannot have moved by " + numberText(moved) + " m");
}

/// The same solid, with the normal of a half-space of length 1 as precisely as doubles can.
Primitive normalised(Primitive primitive) {
  validate(primitive);
  if (auto* half_space = std::get_if<HalfSpace>(&primitive)) {
    const double length = half_space->normal.norm();
    half_space->normal /= length;
    half_space->offset /= length;
  }
  return primitive;
}

}  // namespace

DistanceField::DistanceField(const Primitive& primitive)
    : representation_(normalised(primitive)), surface_box_(boundingBox(primitive)) {}

DistanceField::DistanceField(
    std::variant<Primitive, std::shared_ptr<const SparseGrid>, std::shared_ptr<const AdaptiveGrid>> grid,
    const AlignedBox3d& surface_box, std::shared_ptr<const OpeningCaps> openings, double moved)
    : representation_(std::move(grid)), surface_box_(surface_box), openings_(std::move(openings)), moved_(moved) {}

DistanceField FieldAccess::make(std::shared_ptr<const SparseGrid> grid, std::shared_ptr<const OpeningCaps> openings,
                                double moved) {
  requireValid(grid.get(), moved);
  const AlignedBox3d& surface_box = grid->shape().surface_box;
  return {std::move(grid), surface_box, std::move(openings), moved};
}

DistanceField FieldAccess::make(std::shared_ptr<const AdaptiveGrid> grid, std::shared_ptr<const OpeningCaps> openings,
                                double moved) {
  requireValid(grid.get(), moved);
  const AlignedBox3d& surface_box = grid->shape().surface_box;
  return {std::move(grid), surface_box, std::move(openings), moved};
}

const Primitive* DistanceField::primitive() const {
  return std::get_if<Primitive>(&representation_);
}

const SparseGrid* FieldAccess::grid(const DistanceField& field) {
  const auto* grid = std::get_if<std::shared_ptr<const SparseGrid>>(&field.representation_);
  return grid ? grid->get() : nullptr;
}

const AdaptiveGrid* FieldAccess::adaptive(const DistanceField& field) {
  const auto* grid = std::get_if<std::shared_ptr<const AdaptiveGrid>>(&field.representation_);
  return grid ? grid->get() : nullptr;
}

FieldSample DistanceField::sample(const Vector3d& p_F) const {
  if (const Primitive* shape = primitive()) {
    const double value = signedDistance(*shape, p_F);
    return {value, 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(value) + p_F.lpNorm<Eigen::Infinity>()),
            distanceGradient(*shape, p_F)};
  }
  const AlignedBox3d within = box();
  const Vector3d q = p_F.cwiseMax(within.min()).cwiseMin(within.max());
  const FieldSample within_box = FieldAccess::adaptive(*this) ? sampleWithin(*FieldAccess::adaptive(*this), q)
                                                              : sampleWithin(*FieldAccess::grid(*this), q);
  FieldSample sample = q == p_F ? within_box : outsideSample(surface_box_, p_F, q, within_box);
  sample.error += moved_;
  return sample;
}

FieldSample DistanceField::meshSample(const Vector3d& p_F) const {
  const FieldSample known = sample(p_F);
  return openings_ ? overMesh(known, *openings_, p_F) : known;
}

double DistanceField::openingDistance(const Vector3d& p_F) const {
  return openings_ ? openings_->distance(p_F) : kInfinity;
}

FieldValue DistanceField::interpolate(const Vector3d& p_F) const {
  if (const Primitive* shape = primitive()) return {signedDistance(*shape, p_F), distanceGradient(*shape, p_F)};
  if (box().contains(p_F)) {
    return FieldAccess::adaptive(*this) ? interpolateWithin(*FieldAccess::adaptive(*this), p_F)
                                        : interpolateWithin(*FieldAccess::grid(*this), p_F);
  }
  const FieldSample outside = sample(p_F);
  return {outside.value, outside.gradient};
}

DistanceBounds DistanceField::bounds(const Vector3d& p_F) const {
  if (const Primitive* shape = primitive()) {
    const double distance = signedDistance(*shape, p_F);
    return {distance, distance};
  }
  const double to_surface_box = surface_box_.exteriorDistance(p_F);
  if (!box().contains(p_F)) return {to_surface_box - moved_, kInfinity};
  DistanceBounds bounds = FieldAccess::adaptive(*this) ? boundsWithin(*FieldAccess::adaptive(*this), p_F)
                                                       : boundsWithin(*FieldAccess::grid(*this), p_F);
  // Inside the surface's box a point may be inside the body, so the distance to the box says nothing there.
  if (to_surface_box > 0.0) bounds.low = std::max(bounds.low, to_surface_box);
  return {bounds.low - moved_, bounds.high + moved_};
}

double DistanceField::band() const {
  if (primitive()) return kInfinity;
  return FieldAccess::adaptive(*this) ? FieldAccess::adaptive(*this)->shape().band
                                      : FieldAccess::grid(*this)->shape().band;
}

double DistanceField::errorBound() const {
  if (primitive()) return 0.0;
  return moved_ + (FieldAccess::adaptive(*this) ? FieldAccess::adaptive(*this)->shape().error_bound
                                                : FieldAccess::grid(*this)->errorBound());
}

std::size_t DistanceField::bytes() const {
  if (primitive()) return sizeof(Primitive);
  return (FieldAccess::adaptive(*this) ? FieldAccess::adaptive(*this)->bytes() : FieldAccess::grid(*this)->bytes()) +
         (openings_ ? openings_->bytes() : 0);
}

std::size_t DistanceField::cells() const {
  if (primitive()) return 0;
  return FieldAccess::adaptive(*this) ? FieldAccess::adaptive(*this)->leafCount()
                                      : FieldAccess::grid(*this)->storedCells();
}

AlignedBox3d DistanceField::box() const {
  if (primitive()) return surface_box_;
  return FieldAccess::adaptive(*this) ? FieldAccess::adaptive(*this)->shape().box()
                                      : FieldAccess::grid(*this)->shape().box();
}

}  // namespace sdf_ccd
