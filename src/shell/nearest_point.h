#pragma once

#include <cstdint>
#include <vector>

#include "mesh/box_measures.h"
#include "sampled_points.h"

namespace sdf_ccd {

/// A k-d tree over the points of a shell.
class NearestPoint {
 public:
  explicit NearestPoint(const SampledPoints& shell);

  struct Hit {
    std::int32_t index = -1;  ///< in the shell; -1 if there is no such point
    double distance2 = 0.0;
    Vector3d point = Vector3d::Zero();
  };

  /// The nearest point whose normal does not oppose `facing`; with a zero vector, of all points. Of equally near points
  /// the one with the smallest index.
  Hit find(const Vector3d& p, const Vector3d& facing) const;

  /// Calls visit(index, point) for all such points within `radius` of p.
  template <typename Visit>
  void forEachWithin(const Vector3d& p, double radius, const Vector3d& facing, Visit visit) const {
    if (!nodes_.empty()) visitWithin(0, p, radius * radius, facing, visit);
  }

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

  template <typename Visit>
  void visitWithin(std::int32_t index, const Vector3d& p, double radius2, const Vector3d& facing, Visit& visit) const {
    const Node& node = nodes_[index];
    if (squaredDistance(node.box, p) > radius2) return;
    if (node.count == 0) {
      visitWithin(node.first, p, radius2, facing, visit);
      visitWithin(node.first + 1, p, radius2, facing, visit);
      return;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Entry& entry = entries_[i];
      if ((entry.point - p).squaredNorm() <= radius2 && entry.normal.dot(facing) >= 0) visit(entry.index, entry.point);
    }
  }

  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
};

}  // namespace sdf_ccd
