#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mesh/triangle_tree.h"
#include "oracle/random.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::benchmark {

struct SegmentCase {
  std::string name;
  std::vector<Segment> segments;
};

/// The cube around a mesh's box: the paper's "distance field box".
inline AlignedBox3d studyBox(const TriangleMesh& mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  const double half = 0.5 * box.sizes().maxCoeff();
  return {box.center().array() - half, box.center().array() + half};
}

/// Fixed sets of random segments.
/// A: both ends uniform in the cube (paper, Table 2). B1: start uniform, length 1 % of the cube's diagonal, as in a
/// robot's control cycle. B2: as B1, starting within 2 % of the diagonal from the surface. B2_outside: those of B2 that
/// start outside.
inline std::vector<SegmentCase> segmentCases(const TriangleMesh& mesh, std::size_t count) {
  const AlignedBox3d box = studyBox(mesh);
  const double diagonal = box.sizes().norm(), length = 0.01 * diagonal, reach = 0.02 * diagonal;
  test::Random random(20140924);
  SegmentCase a{"A", {}}, b1{"B1", {}}, b2{"B2", {}}, outside{"B2_outside", {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d start = test::uniformIn(random, box);
    a.segments.push_back({start, test::uniformIn(random, box)});
  }
  const auto shortFrom = [&](const Vector3d& start) {
    return Segment{start, start + length * test::direction(random)};
  };
  for (std::size_t i = 0; i < count; ++i) b1.segments.push_back(shortFrom(test::uniformIn(random, box)));
  const TriangleTree tree(mesh);
  const AlignedBox3d near_box(box.min().array() - reach, box.max().array() + reach);
  while (b2.segments.size() < count) {
    const Vector3d start = test::uniformIn(random, near_box);
    if (tree.closestPoint(start, reach).triangle < 0) continue;
    b2.segments.push_back(shortFrom(start));
    if (tree.windingNumber(start) < 0.5) outside.segments.push_back(b2.segments.back());
  }
  return {std::move(a), std::move(b1), std::move(b2), std::move(outside)};
}

}  // namespace sdf_ccd::benchmark
