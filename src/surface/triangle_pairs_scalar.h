#pragma once

#include "surface/triangle_pairs.h"

namespace sdf_ccd {

/// The same as planeGaps(), closestGaps() and edgeGaps(), one pair at a time.
void planeGapsOneByOne(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs);
void closestGapsOneByOne(const EndPoses& poses, TrianglePairs& pairs);
void edgeGapsOneByOne(const EndPoses& poses, TrianglePairs& pairs);

}  // namespace sdf_ccd
