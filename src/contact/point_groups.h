#pragma once

#include <cstdint>
#include <vector>

#include "query/shell_query.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

/// What the points below a node of a shell's tree are together.
struct NodeSum {
  Vector3f centroid;  ///< of their areas, from the shell's origin [m]
  Vector3f normal;    ///< mean by area; not unit
  float area;         ///< [m²]
};

/// One per node; empty for a shell so small that its points need no grouping.
std::vector<NodeSum> nodeSums(const PointShell& shell, const SphereTree& tree);

/// A shell whose points may be grouped.
struct GroupedShell {
  const PointShell& shell;
  const SphereTree& tree;
  const std::vector<NodeSum>& sums;
};

/// Joins shell points that are deep inside a field along a whole chord, so that the cost of a deep contact
/// does not grow with the number of points.
///
/// Points of a node are a group if the node's radius is at most a quarter of the depth of its centre, which it is all
/// along the chord, and an eighth of the shell's. All of their area bears at its centroid: exact for the force in a
/// field that is linear among the points, as mostly it is at such a depth; the moments that are left out, of the area
/// about its centroid, are at most a 64th of the shell's. Elsewhere, as across the middle between two faces, the error
/// is about the share of the depth by which the field bends within the group.
class PointGroups {
 public:
  struct Group {
    std::int32_t node;
    int chord;
    double reach;  ///< upper bound of the depth of its points [m]
  };

  /// Divides the points that a query found inside along whole chords: into groups(), and hits of single points.
  /// @param points  receives the latter, and the query's hits; replaced.
  void divide(const DistanceField& field, const GroupedShell& shell, const ChordPath& path,
              const ShellQueryResult& query, std::vector<ShellHit>& points);

  const std::vector<Group>& groups() const { return groups_; }

  /// Points that stand for the groups: the centroids, with a hit each.
  const PointShell& shell() const { return centroids_; }
  const std::vector<ShellHit>& hits() const { return hits_; }

  /// Sets one real point of each group, and further ones that may be deeper than `known` and these [m]. Lowers the
  /// groups' reach where that shows that no point is as deep. @param points  replaced.
  void findDeep(const DistanceField& field, const GroupedShell& shell, const ChordPath& path, double known,
                std::vector<ShellHit>& points);

 private:
  struct Open {
    double reach;
    std::int32_t node;
    int group;
  };

  std::vector<Group> groups_;
  PointShell centroids_;
  std::vector<ShellHit> hits_;
  std::vector<std::int32_t> stack_;
  std::vector<Open> open_;  // a heap
};

}  // namespace sdf_ccd
