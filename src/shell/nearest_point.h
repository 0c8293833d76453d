#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/eigen_types.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// A k-d tree over the points of a shell.
class NearestPoint {
 public:
  explicit NearestPoint(const PointShell& shell);

  struct Hit {
    std::int32_t index = -1;  ///< in the shell; -1 if there is no such point
    double distance2 = 0.0;
  };

  /// Nearest point whose normal does not point against `facing`; a zero vector takes all. Of equally near points
  /// the one with the least index.
  Hit find(const Vector3d& p, const Vector3d& facing) const;

 private:
  struct Node {
    AlignedBox3d box;
    std::int32_t first;  ///< first of two children, or first point of a leaf
    std::int32_t count;  ///< points of a leaf; 0 for an inner node
  };
  struct Entry {
    Vector3d point, normal;
    std::int32_t index;
  };
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
};

}  // namespace sdf_ccd
