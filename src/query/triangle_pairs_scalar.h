#pragma once

#include "lanes/triangle_pairs.h"

namespace sdf_ccd {

/// The same as planeGaps() and closestGaps(), one pair at a time.
void planeGapsOneByOne(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs);
void closestGapsOneByOne(const EndPoses& poses, TrianglePairs& pairs);

}  // namespace sdf_ccd
