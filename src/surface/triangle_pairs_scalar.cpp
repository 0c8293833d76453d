// The functions of lanes/triangle_pairs.cpp one pair at a time: for builds without Highway, and to test it against.
#include "triangle_pairs_scalar.h"

#include "triangle_pair.h"

namespace sdf_ccd {
namespace {

Corners cornersAt(const std::array<TrianglePairs::Vectors, 3>& corners, int i) {
  Corners t;
  for (int corner = 0; corner < 3; ++corner)
    for (int k = 0; k < 3; ++k) t[corner][k] = corners[corner][k][i];
  return t;
}

Corners moved(const Isometry3d& X, const Corners& t) {
  return {X * t[0], X * t[1], X * t[2]};
}

/// One pair: A, and B at both ends and halfway.
struct Pair {
  Pair(const EndPoses& poses, const TrianglePairs& pairs, int i)
      : a(cornersAt(pairs.a, i)),
        start(moved(poses.X_AB_start, cornersAt(pairs.b, i))),
        end(moved(poses.X_AB_end, cornersAt(pairs.b, i))) {
    for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (start[k] + end[k]);
  }

  void offer(const Vector3d& axis, int i, TrianglePairs& pairs) const {
    const double gap = std::min(gapAlong(axis, a, start), gapAlong(axis, a, end));
    if (!(gap > pairs.gap[i])) return;
    pairs.gap[i] = gap;
    for (int k = 0; k < 3; ++k) pairs.axis[k][i] = axis[k] / axis.norm();
  }

  Corners a, start, end, middle;
};

/// In the triangle's plane, away from it across an edge.
Vector3d outward(const Corners& t, int edge) {
  return (t[(edge + 1) % 3] - t[edge]).cross(areaNormal(t));
}

}  // namespace

void planeGapsOneByOne(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs) {
  for (int i = 0; i < pairs.size; ++i) {
    const Pair pair(poses, pairs, i);
    pairs.gap[i] = -1e300;
    pair.offer(direction_A, i, pairs);
    for (const Vector3d& normal : {areaNormal(pair.a), areaNormal(pair.middle)}) {
      pair.offer(normal, i, pairs);
      pair.offer(-normal, i, pairs);
    }
  }
}

void closestGapsOneByOne(const EndPoses& poses, TrianglePairs& pairs) {
  for (int i = 0; i < pairs.size; ++i) {
    const Pair pair(poses, pairs, i);
    const ClosestPair closest = closestPoints(pair.a, pair.middle);
    pairs.gap[i] = -1e300;
    pair.offer(closest.on_b - closest.on_a, i, pairs);
    pairs.distance2[i] = closest.distance2;
  }
}

void edgeGapsOneByOne(const EndPoses& poses, TrianglePairs& pairs) {
  for (int i = 0; i < pairs.size; ++i) {
    const Pair pair(poses, pairs, i);
    for (int k = 0; k < 3; ++k) {
      pair.offer(outward(pair.a, k), i, pairs);
      pair.offer(-outward(pair.middle, k), i, pairs);
    }
  }
}

#ifndef SDF_CCD_HIGHWAY
void planeGaps(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs) {
  planeGapsOneByOne(poses, direction_A, pairs);
}

void closestGaps(const EndPoses& poses, TrianglePairs& pairs) {
  closestGapsOneByOne(poses, pairs);
}

void edgeGaps(const EndPoses& poses, TrianglePairs& pairs) {
  edgeGapsOneByOne(poses, pairs);
}
#endif

}  // namespace sdf_ccd
