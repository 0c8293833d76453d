#pragma once

#include <vector>

#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// A ball around a body's geometry, in its frame; of infinite radius for a half-space, of none without geometry.
BoundingBall extentBall(const std::vector<GeometryDescription>& geometry);

/// Lower bound of the distance from p (in the body's frame) to the geometry [m]; may be negative inside.
double distanceBelow(const std::vector<GeometryDescription>& geometry, const Vector3d& p);

/// The same elements, of meshes the boxes around them, so that distanceBelow() takes no longer for large ones.
std::vector<GeometryDescription> inBoxes(std::vector<GeometryDescription> geometry);

}  // namespace sdf_ccd
