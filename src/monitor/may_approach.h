#pragma once

#include "query/shell_query.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {

/// False only if every shell point's true distance exceeds `distance` [m] along the whole path. Uses only the field's
/// lower bounds, so it holds for any distance, also beyond the band in which isosurfaces can be found.
inline bool mayApproach(const DistanceField& field, const PointShell& shell, const SphereTree& tree,
                        const ChordPath& path, double distance) {
  struct Walk {
    const DistanceField& field;
    const PointShell& shell;
    const SphereTree& tree;
    const Chord& chord;
    double distance;
    CancelTicks<>& cancel;

    bool near(const Vector3d& p_P, double radius) const {
      return mayTouch(field, {chord.X_FP_start * p_P, chord.X_FP_end * p_P}, radius + distance);
    }
    bool below(const SphereTree::Node& node) const {
      cancel.check();
      if (!near(node.ball().center, node.radius)) return false;
      if (!node.isLeaf()) return below(tree.nodes[node.first_child]) || below(tree.nodes[node.first_child + 1]);
      for (int i = node.begin; i < node.end; ++i)
        if (near(shell.point(static_cast<std::size_t>(i)), 0.0)) return true;
      return false;
    }
  };
  if (tree.nodes.empty()) return false;
  CancelTicks<> cancel;
  for (const Chord& chord : path.chords)
    if (Walk{field, shell, tree, chord, distance, cancel}.below(tree.nodes.front())) return true;
  return false;
}

}  // namespace sdf_ccd
