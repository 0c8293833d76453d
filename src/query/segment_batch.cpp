#include "sdf_ccd/query/segment_batch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef SDF_CCD_HIGHWAY
#include "adaptive_lanes.h"
#include "grid_walk.h"
#endif
#include "representation_queries.h"

namespace sdf_ccd {
namespace {

using Hits = std::vector<SegmentHit>;

/// Segments [first, last), one by one.
void askSingly(const DistanceField& field, const Segment* segments, std::size_t first, std::size_t last,
               const BatchOptions& options, Hits& hits) {
  thread_local Intervals intervals;
  const bool first_only = options.mode != SegmentMode::kAll;
  for (std::size_t i = first; i < last; ++i) {
    segmentIntervals(field, segments[i], {options.sigma, first_only}, intervals);
    for (const Interval& found : intervals) {
      const auto enter = static_cast<float>(found.enter);
      hits.push_back({static_cast<std::uint32_t>(i), enter, first_only ? enter : static_cast<float>(found.exit)});
    }
  }
}

#ifdef SDF_CCD_HIGHWAY

/// One thread's segments in flight, and which they are.
class Chunk {
 public:
  /// Asks segments [first, first + count), count ≤ Flight::kCapacity.
  void ask(const DistanceField& field, const LaneGrid& lanes, const Segment* segments, std::size_t first, int count,
           const BatchOptions& options, Hits& hits) {
    board(*field.adaptive(), segments, first, count);
    followFlights(lanes, options.mode != SegmentMode::kAll, size_, flight_, work_);
    // In the order of segments; those of one segment already are in order of time.
    std::fill_n(begin_.begin(), count + 1, 0);
    for (const std::int32_t lost : work_.lost) retry(field, segments, first, lost, options);
    for (const FlightHit& hit : work_.hits) ++begin_[who_[hit.index] + 1];
    for (int i = 0; i < count; ++i) begin_[i + 1] += begin_[i];
    const std::size_t before = hits.size();
    hits.resize(before + work_.hits.size());
    for (const FlightHit& hit : work_.hits) {
      const double t0 = t0_[hit.index], length = t1_[hit.index] - t0;
      hits[before + begin_[who_[hit.index]]++] = {static_cast<std::uint32_t>(first + who_[hit.index]),
                                                  static_cast<float>(t0 + hit.enter * length),
                                                  static_cast<float>(t0 + hit.exit * length)};
    }
  }

 private:
  void board(const AdaptiveGrid& grid, const Segment* segments, std::size_t first, int count) {
    const AdaptiveShape& shape = grid.shape();
    const Vector3d size = shape.units().cast<double>();
    const double per_metre = 1.0 / shape.unit();
    size_ = 0;
    for (int i = 0; i < count; ++i) {
      const Segment& segment = segments[first + i];
      if (!isWithinReach(segment)) {
        throw std::invalid_argument("segment query: segment " + std::to_string(first + i) +
                                    " is not finite, or reaches farther than 1e12 m");
      }
      Vector3d start = (segment.start - shape.origin) * per_metre;
      Vector3d step = (segment.end - segment.start) * per_metre;
      const Vector3d end = start + step;
      double t0 = 0.0, t1 = 1.0;
      if ((start.array() < 0.0).any() || (end.array() < 0.0).any() || (start.array() > size.array()).any() ||
          (end.array() > size.array()).any()) {
        if (!clipToBox(start, step, size, t0, t1)) continue;
        start += t0 * step;
        step *= t1 - t0;
      }
      const int at = size_++;
      who_[at] = i;
      t0_[at] = t0;
      t1_[at] = t1;
      for (int k = 0; k < 3; ++k) {
        flight_.o[k][at] = static_cast<float>(start[k]);
        flight_.d[k][at] = static_cast<float>(step[k]);
        const int cell = static_cast<int>(flight_.o[k][at]);
        flight_.cell[k][at] = std::clamp(cell, 0, AdaptiveShape::kUnits * shape.size[k] - 1);
      }
      flight_.t[at] = 0.0F;
      flight_.enter[at] = -1.0F;
    }
  }

  /// A flight that did not end: its hits are replaced by those of the single query.
  void retry(const DistanceField& field, const Segment* segments, std::size_t first, std::int32_t lost,
             const BatchOptions& options) {
    auto& hits = work_.hits;
    const auto is_lost = [&](const FlightHit& hit) { return hit.index == static_cast<std::uint32_t>(lost); };
    hits.erase(std::remove_if(hits.begin(), hits.end(), is_lost), hits.end());
    Hits single;
    askSingly(field, segments, first + who_[lost], first + who_[lost] + 1, options, single);
    t0_[lost] = 0.0;
    t1_[lost] = 1.0;
    for (const SegmentHit& hit : single) hits.push_back({static_cast<std::uint32_t>(lost), hit.enter, hit.exit});
  }

  Flight flight_;
  FlightWork work_;
  int size_ = 0;
  std::array<int, Flight::kCapacity> who_;  ///< the segment of each flight, from the chunk's first
  std::array<double, Flight::kCapacity> t0_, t1_;
  std::array<int, Flight::kCapacity + 1> begin_;
};

#endif

}  // namespace

#ifdef SDF_CCD_HIGHWAY
LaneGrid::LaneGrid(const AdaptiveGrid& grid, double sigma_metres) {
  const AdaptiveGrid::Arrays& arrays = grid.arrays();
  const auto words = [](const void* data) { return static_cast<const std::uint32_t*>(data); };
  top = arrays.top.data;
  codes = words(arrays.nodes.data);
  bases = words(arrays.bases.data);
  leaves = words(arrays.leaves.data);
  splits = words(arrays.splits.data);
  for (int k = 0; k < 3; ++k) top_size[k] = grid.shape().size[k];
  const double to_units = 1.0 / grid.shape().unit();
  per_metre = static_cast<float>(to_units);
  sigma = static_cast<float>(sigma_metres * to_units);
  margin = static_cast<float>((std::abs(sigma_metres) + grid.shape().error_bound) * to_units);
  for (int k = 0; k < 3; ++k) far_step[k] = static_cast<float>(grid.farStep(k) * to_units);
  for (int k = 0; k < 8; ++k) {
    offset[k] = static_cast<float>(grid.scale(1 << k).offset * to_units);
    corner[k] = static_cast<float>(grid.scale(1 << k).corner * to_units);
  }
}
#endif

void segmentIntervals(const DistanceField& field, const Segment* segments, std::size_t count,
                      const BatchOptions& options, BatchResult& result) {
  checkIsovalue(field, options.sigma);
  result.hits.clear();
  constexpr std::size_t kChunk = 2048;
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  const auto askChunk = [&](std::size_t chunk, Hits& hits) {
    const std::size_t first = chunk * kChunk, last = std::min(count, first + kChunk);
#ifdef SDF_CCD_HIGHWAY
    if (const AdaptiveGrid* grid = field.adaptive()) {
      static_assert(kChunk == Flight::kCapacity, "a chunk fills one flight");
      thread_local std::unique_ptr<Chunk> flights = std::make_unique<Chunk>();
      flights->ask(field, LaneGrid(*grid, options.sigma), segments, first, static_cast<int>(last - first), options,
                   hits);
      return;
    }
#endif
    askSingly(field, segments, first, last, options, hits);
  };
  if (chunks <= 1) {
    if (chunks == 1) askChunk(0, result.hits);
    return;
  }
  std::vector<Hits> found(chunks);
  // Isolated: while it waits, this thread must not begin other work of the caller's that shares its memory.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) { askChunk(i, found[i]); }); });
  for (const Hits& hits : found) result.hits.insert(result.hits.end(), hits.begin(), hits.end());
}

}  // namespace sdf_ccd
