#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Upper bound of the distance from a triangle's points to a mesh.
class ReachBound {
 public:
  /// @param crack  where a triangle is nearer to the mesh than this, all triangles within this distance are tried [m].
  ReachBound(const TriangleTree& tree, double crack) : tree_(tree), crack_(crack) {}

  double of(const Corners& t);

 private:
  double boundByOne(const Corners& t);
  double bound(const Corners& t, int depth);

  const TriangleTree& tree_;
  const double crack_;
  double least_ = 0.0;  // distance of the last triangle's centre
  std::vector<int> near_;
};

}  // namespace sdf_ccd
