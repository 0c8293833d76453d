#pragma once

#include <array>

#include "chord_impulses.h"
#include "common/compiler_lanes.h"
#include "field/uniform/sparse_grid.h"
#include "gauss_nodes.h"

namespace sdf_ccd {

/// A field whose gradient is less than this has no direction [squared]: far inside.
constexpr double kNoDirection2 = 1e-18;

/// Shell points that each stay in one cell of a field along a whole chord: as many as there are lanes.
struct CellPaths {
  static constexpr int kCount = lanes::kWidth;
  using Column = std::array<double, kCount>;

  std::array<Column, 8> corners = {};           ///< of the cell [m]
  std::array<Column, 3> from = {}, to = {};     ///< in the cell, [0, 1]³
  Column side = {};                             ///< of the cell [m]
  std::array<Column, 3> start = {}, step = {};  ///< as ChordPoint
  Column stiffness = {};                        ///< [N/m]; 0, like the damping, in lanes that are not used
  Column damping = {};                          ///< [N·s/m]
};

/// Places paths by their `start` and `step` in the cells of a uniform grid, as CellReader::enter(): sets corners, from,
/// to and side.
/// @return bit i: path i is in one cell with corner values; else its cell is not set.
unsigned placeInGrid(const SparseGrid& grid, CellPaths& paths);

/// Where points are deepest.
struct CellDepths {
  CellPaths::Column u;                      ///< time, [0, 1]
  CellPaths::Column value;                  ///< [m]
  std::array<CellPaths::Column, 3> normal;  ///< the field's at u, if that is 0 or 1
  CellPaths::Column bears;                  ///< 1; 0 if the field has no direction somewhere: nothing has been added
};

/// Adds up the impulses of such points along one chord after another.
class CellImpulses {
 public:
  /// Adds the impulses of all lanes, N as the field has it. @param duration  of the chord [s].
  void add(const CellPaths& paths, double duration, CellDepths& depths);

  /// Adds what has been added here during a chord to what other points bear, and forgets it.
  void moveTo(ChordImpulses& impulses);

  /// By lane, at one of kGaussNodes.
  struct Sum {
    std::array<CellPaths::Column, 3> impulse = {};  ///< [N·s]
    std::array<CellPaths::Column, 3> angular = {};  ///< about near_F [N·m·s]
  };

 private:
  bool bears_ = false;
  Vector3d near_F_ = Vector3d::Zero();
  std::array<Sum, kGaussNodes.size()> sums_;
};

}  // namespace sdf_ccd
