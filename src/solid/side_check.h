#pragma once

#include <vector>

#include "common/lattice.h"
#include "mesh/triangle_tree.h"
#include "solid/openings/openings.h"

namespace sdf_ccd {

/// Compares the closed mesh with the winding number of the open one on a grid of cells.
class SideCheck {
 public:
  /// @param mesh  must outlive this.
  explicit SideCheck(const TriangleMesh& mesh);

  const TriangleTree& tree() const { return tree_; }

  /// Sets `openings.doubt`; returns the cells that are clearly inside, but outside of the mesh with its caps.
  std::vector<Vector3i> missing(Openings& openings) const;

  /// Adds the surface of these cells as one body.
  void addVoxels(const std::vector<Vector3i>& cells, Openings& openings) const;

 private:
  static constexpr int kCells = 20;  // along the longest side

  Vector3d center(const Vector3i& c) const { return origin_ + cell_ * (c.cast<double>().array() + 0.5).matrix(); }
  std::size_t index(const Vector3i& c) const { return indexIn(counts_, c); }

  const TriangleMesh& mesh_;
  TriangleTree tree_;
  double cell_;
  Vector3i counts_;
  Vector3d origin_;
  std::vector<double> winding_;  // of the mesh alone
};

}  // namespace sdf_ccd
