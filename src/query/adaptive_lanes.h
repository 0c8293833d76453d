#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sdf_ccd/field/adaptive_grid.h"

namespace sdf_ccd {

/// An adaptive grid as vector code reads it: raw words, lengths in units.
struct LaneGrid {
  explicit LaneGrid(const AdaptiveGrid& grid, double sigma);

  const std::uint32_t* top;
  const std::uint32_t* codes;   ///< four codes a word
  const std::uint32_t* bases;   ///< three a node
  const std::uint32_t* leaves;  ///< two words each
  const std::uint32_t* splits;
  std::array<std::int32_t, 3> top_size;
  float per_metre;  ///< units
  float sigma;      ///< [units]
  float margin;     ///< |sigma| and the leaves' error: a ball of the true distance less this is free [units]
  std::array<float, 3> far_step;        ///< [units], by depth
  std::array<float, 8> offset, corner;  ///< [units] per step, by log2 of the leaf's side
};

/// Segments on their way through a grid, an array per quantity. A segment runs from o to o + d within the grid's box
/// while its parameter t goes from 0 to 1; lengths in units.
struct Flight {
  static constexpr int kCapacity = 2048;
  static constexpr int kSlack = 64;  ///< beyond the end, so that whole vectors may be read
  template <class T>
  using Column = std::array<T, kCapacity + kSlack>;

  std::array<Column<float>, 3> o, d;
  std::array<Column<std::int32_t>, 3> cell;  ///< unit cube
  Column<float> t;
  Column<float> enter;            ///< t since when it is inside; -1: outside
  Column<std::int32_t> leaf;      ///< index of the leaf it is in; splits' leaves have kSplit added
  Column<std::int32_t> log_side;  ///< of that leaf
  static constexpr std::int32_t kSplit = 1 << 30;
};

/// Something inside: of flight number `index`, in its own parameter.
struct FlightHit {
  std::uint32_t index;
  float enter;
  float exit;
};

/// Numbers of flights, with room for whole vectors.
using FlightList = Flight::Column<std::int32_t>;

struct FlightWork {
  FlightList moving, at_node, at_leaf, spare;
  std::vector<FlightHit> hits;
  std::vector<std::int32_t> lost;  ///< to be asked one by one: those that did not end
};

/// Follows flights 0 to count − 1 to their ends, or to their first hit. Hits of one flight are in order.
void followFlights(const LaneGrid& grid, bool first_only, int count, Flight& flight, FlightWork& work);

}  // namespace sdf_ccd
