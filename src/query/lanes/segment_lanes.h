#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/adaptive/adaptive_grid.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// A grid as read by vector code. Lengths are in units; a top cell (the coarsest) has kUnits along its side.
struct LaneBox {
  static constexpr int kUnits = 128;
  static constexpr int kLogUnits = 7;

  std::array<double, 3> origin;  ///< [m]
  double units_per_metre;
  std::array<std::int32_t, 3> top_size;  ///< top cells per axis
  const std::uint32_t* top;              ///< a word per top cell, x fastest
  float ball_step;                       ///< of EmptySphere [units]
  float ball_offset;  ///< position of a top cell in the lattice of spheres' centres, from its first corner [units]
  float margin;       ///< if a sphere's radius is |φ| minus this, the field is nowhere sigma in it [units]
  float leaf_margin;  ///< the same for |leaf's value − sigma|, beyond the leaf [units]
};

/// An adaptive grid: its raw arrays.
struct AdaptiveLanes : LaneBox {
  AdaptiveLanes(const AdaptiveGrid& grid, double sigma);

  const AdaptiveNode* nodes;
  const NodeBases* bases;
  const LeafWord* leaves;
  const SplitLeaves* splits;
  float sigma;  ///< [units]
  /// [units] per step for a node or leaf of side 0, and the increment per unit of side: of far children's distances
  /// (AdaptiveGrid::farStepFor) and of leaves' rounding (LeafScale).
  float far_step, far_step_per_side;
  float offset, offset_per_side, corner, corner_per_side;
};

/// A uniform grid: a top cell is a brick.
struct UniformLanes : LaneBox {
  static constexpr int kLogCell = 4;  ///< log2 of the units along a cell's side

  UniformLanes(const SparseGrid& grid, double sigma);

  const std::int16_t* samples;  ///< [steps]
  float sigma;                  ///< [steps]
  float per_sample;             ///< units in a step
  float rounding;               ///< by which two samples' difference may exceed that of their true distances [units]
};

/// For each mask of eight lanes: the indices of the set ones, in order; then zeros.
constexpr std::array<std::array<std::uint8_t, 8>, 256> frontLanes() {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (int bits = 0; bits < 256; ++bits) {
    for (int lane = 0, next = 0; lane < 8; ++lane) {
      if (bits >> lane & 1) table[bits][next++] = static_cast<std::uint8_t>(lane);
    }
  }
  return table;
}
inline constexpr auto kFrontLanes = frontLanes();

/// The indices of a vector's lanes, for any processor.
alignas(64) inline constexpr std::array<std::int32_t, 16> kLaneNumbers{0, 1, 2,  3,  4,  5,  6,  7,
                                                                       8, 9, 10, 11, 12, 13, 14, 15};

/// Segments that wait for the same kind of step, one array per quantity. A segment runs from o to o + d within the
/// grid's box while its parameter t goes from 0 to 1; lengths in units.
struct alignas(64) RayQueue {
  static constexpr int kCapacity = 512;  ///< also of active rays: enough to fill vectors, few enough for the cache
  static constexpr int kSlack = 32;      ///< beyond the end, so that whole vectors may be read and written
  template <class T>
  using Column = std::array<T, kCapacity + kSlack>;

  /// Leaves of splits have this added to their index.
  static constexpr std::int32_t kSplit = 1 << 30;

  std::array<Column<float>, 3> o, d;
  Column<float> t;
  Column<float> enter;                       ///< t since when it is inside; -1: outside
  std::array<Column<std::int32_t>, 3> cell;  ///< unit cube
  Column<std::int32_t> id;                   ///< of the segment
  Column<std::int32_t> index;                ///< index of the top cell, node or leaf that it waits for
  Column<std::int32_t> log_side;             ///< of that block
  int size = 0;
};

/// The memory that a queue's rays wait for, loaded ray by ray before the vector step: many plain loads are
/// in flight at once, and each costs less than a lane of a gather.
struct alignas(64) Fetched {
  using Pairs = std::array<std::int32_t, 2 * std::tuple_size_v<RayQueue::Column<std::int32_t>>>;

  RayQueue::Column<std::int32_t> word;  ///< of a top cell; a node's code; a sample's bits
  RayQueue::Column<std::int32_t> base;  ///< of a node's children of that code's kind
  std::array<Pairs, 4> pairs;           ///< of a leaf's corners: two words a ray, or one
};

/// Where segments are inside; those of one segment in order of time.
struct RayHits {
  static constexpr int kSlack = 32;

  std::vector<std::int32_t> id;
  std::vector<float> enter, exit;
  int size = 0;  ///< and room beyond it for a vector

  void makeRoom() {
    if (size + kSlack > static_cast<int>(id.size())) resize(2 * size + 1024);
  }
  void add(std::int32_t segment, float begin, float end) {
    makeRoom();
    id[size] = segment;
    enter[size] = begin;
    exit[size++] = end;
  }
  void resize(int room) {
    id.resize(room);
    enter.resize(room);
    exit.resize(room);
  }
};

/// Input and output of followRays(); reused.
struct RayWork {
  static constexpr int kSegments = 8192;  ///< upper bound

  std::array<RayQueue, 2> top, node;  ///< alternately: one is read, the other written
  RayQueue leaf;
  Fetched fetched;
  std::array<float, kSegments> begin, end;  ///< the part of each segment that is within the grid's box
  RayHits hits;
  std::vector<std::int32_t> unfinished;  ///< to be queried one by one: rays that were not completed
};

/// Follows segments 0 to count − 1 to their ends, or to the beginning of their first hit, without computing its end.
/// @return the index of a segment that is not within reach; −1 if there is none.
int followRays(const AdaptiveLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work);
int followRays(const UniformLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work);

}  // namespace sdf_ccd
