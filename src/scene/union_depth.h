#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "common/infinity.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Parts that are apart by no more than this count as touching, as rounding may separate faces that coincide [m].
constexpr double kTouchingParts = 1e-8;

/// Contains one part of a body: a box in the part's frame G, or a half-space.
struct PartExtent {
  const Isometry3d& X_BG;
  AlignedBox3d box_G;
  const HalfSpace* half_space = nullptr;

  /// How far the part goes along a direction from the body's origin [m]. @param is_own  that of the half-space's
  /// normal.
  double farthest(const Vector3d& direction_B, bool is_own) const {
    if (half_space) return is_own ? direction_B.dot(X_BG.translation()) + half_space->offset : kInfinity;
    const Vector3d along = (X_BG.linear().transpose() * direction_B).cwiseAbs();
    return direction_B.dot(X_BG * box_G.center()) + 0.5 * along.dot(box_G.sizes());
  }
};

/// Upper bound of the depth of a point in the union of a body's parts [m]: the distance out of all of them along one of
/// the body's axes, or along the normal of a half-space. 0 where that shows that it is outside.
///
/// The depth below the surface of one part is no bound where parts meet, as its nearest surface may lie within another.
/// @param extentOf  the PartExtent of part i of so many.
template <class ExtentOf>
double boundOfUnionDepth(std::size_t parts, const ExtentOf& extentOf, const Vector3d& p_B) {
  constexpr double kRounding = 1e-12;
  const auto wayOut = [&](const Vector3d& direction, std::size_t own) {
    double farthest = -kInfinity;
    for (std::size_t i = 0; i < parts; ++i) farthest = std::max(farthest, extentOf(i).farthest(direction, i == own));
    return farthest - direction.dot(p_B) + kRounding * (std::abs(farthest) + p_B.norm());
  };
  double least = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) least = std::min(least, wayOut(side * Vector3d::Unit(axis), parts));
  for (std::size_t i = 0; i < parts; ++i) {
    const PartExtent part = extentOf(i);
    if (part.half_space) least = std::min(least, wayOut(part.X_BG.linear() * part.half_space->normal, i));
  }
  return std::max(0.0, least);
}

/// Of a part with a field.
inline PartExtent extentOf(const Isometry3d& X_BG, const DistanceField& field) {
  const Primitive* primitive = field.primitive();
  const auto* half_space = primitive ? std::get_if<HalfSpace>(primitive) : nullptr;
  if (half_space) return {X_BG, {}, half_space};
  const Vector3d moved = Vector3d::Constant(field.moved());
  return {X_BG, {field.surfaceBox().min() - moved, field.surfaceBox().max() + moved}};
}

/// Upper bound of a point's depth in a body [m], of which that in one of its parts is known not to exceed `depth`;
/// minus infinity if no other part is as near, so that the depth in the part is that in the body.
inline double boundOfUnionDepth(const Body& body, const Vector3d& p_B, double depth) {
  int near = 0;
  for (const BodyPart& part : body.parts)
    near += part.field.lowerBound(part.X_BG.inverse() * p_B) <= depth + kTouchingParts;
  if (near < 2) return -kInfinity;
  const auto extent = [&](std::size_t i) { return extentOf(body.parts[i].X_BG, body.parts[i].field); };
  return boundOfUnionDepth(body.parts.size(), extent, p_B);
}

}  // namespace sdf_ccd
