#include "sdf_ccd/segments.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef SDF_CCD_HIGHWAY
#include "query/lanes/segment_lanes.h"
#endif
#include "common/cancel_point.h"
#include "field/field_access.h"
#include "representation_queries.h"
#include "segment_reach.h"

namespace sdf_ccd {
namespace {

using Hits = std::vector<SegmentHit>;

[[noreturn]] void refuse(std::size_t segment) {
  failOutOfReach("segment query: segment " + std::to_string(segment));
}

/// Queries segments [first, last) one by one.
void querySingly(const DistanceField& field, const Segment* segments, std::size_t first, std::size_t last,
                 const SegmentOptions& options, Hits& hits) {
  thread_local Intervals intervals;
  for (std::size_t i = first; i < last; ++i) {
    if (!isWithinReach(segments[i])) refuse(i);
    segmentIntervals(field, segments[i], options, intervals);
    for (const Interval& found : intervals) {
      hits.push_back({static_cast<std::uint32_t>(i), static_cast<float>(found.enter), static_cast<float>(found.exit)});
    }
  }
}

#ifdef SDF_CCD_HIGHWAY

/// One thread's active segments.
class Chunk {
 public:
  /// Queries segments [first, first + count), count ≤ RayWork::kSegments.
  template <class Lanes>
  void query(const DistanceField& field, const Lanes& lanes, const Segment* segments, std::size_t first, int count,
             const SegmentOptions& options, Hits& hits) {
    const bool first_only = stopsAtEnter(options.mode);
    const int refused = followRays(lanes, first_only, segments + first, count, work_);
    if (refused >= 0) refuse(first + refused);
    for (const std::int32_t unfinished : work_.unfinished) retry(field, segments, first, unfinished, options);
    const std::size_t before = hits.size();
    hits.resize(before + work_.hits.size);
    first_only ? sortFirst(first, hits.data() + before) : sortAll(first, count, hits.data() + before);
  }

 private:
  /// Converts a ray's parameter (within the grid's box) to that of the segment.
  float time(std::size_t id, float t) const {
    const float begin = work_.begin[id], end = work_.end[id];
    return t < 1.0F ? begin + t * (end - begin) : end;
  }

  /// Sorts hits by segment; the hits of one segment already are in order of time.
  void sortAll(std::size_t first, int count, SegmentHit* sorted) {
    const RayHits& found = work_.hits;
    std::fill_n(position_.begin(), count + 1, 0);
    for (int i = 0; i < found.size; ++i) ++position_[found.id[i] + 1];
    for (int i = 0; i < count; ++i) position_[i + 1] += position_[i];
    for (int i = 0; i < found.size; ++i) {
      const std::int32_t id = found.id[i];
      sorted[position_[id]++] = {static_cast<std::uint32_t>(first + id), time(id, found.enter[i]),
                                 time(id, found.exit[i])};
    }
  }

  /// The same if no segment has two hits.
  void sortFirst(std::size_t first, SegmentHit* sorted) {
    const RayHits& found = work_.hits;
    has_hit_.fill(0);
    for (int i = 0; i < found.size; ++i) {
      const std::int32_t id = found.id[i];
      has_hit_[id / 64] |= std::uint64_t{1} << id % 64;
      position_[id] = i;
    }
    for (std::size_t k = 0; k < has_hit_.size(); ++k) {
      for (std::uint64_t left = has_hit_[k]; left != 0; left &= left - 1) {
        const std::size_t id = 64 * k + __builtin_ctzll(left);
        const float enter = time(id, found.enter[position_[id]]);
        *sorted++ = {static_cast<std::uint32_t>(first + id), enter, enter};
      }
    }
  }

  /// Replaces the hits of a ray that was not completed by those of the single query.
  void retry(const DistanceField& field, const Segment* segments, std::size_t first, std::int32_t unfinished,
             const SegmentOptions& options) {
    RayHits& hits = work_.hits;
    int kept = 0;
    for (int i = 0; i < hits.size; ++i) {
      if (hits.id[i] == unfinished) continue;
      hits.id[kept] = hits.id[i];
      hits.enter[kept] = hits.enter[i];
      hits.exit[kept++] = hits.exit[i];
    }
    hits.size = kept;
    Hits single;
    querySingly(field, segments, first + unfinished, first + unfinished + 1, options, single);
    work_.begin[unfinished] = 0.0F;
    work_.end[unfinished] = 1.0F;
    for (const SegmentHit& hit : single) {
      hits.add(unfinished, hit.enter, hit.exit);
    }
  }

  RayWork work_;
  std::array<int, RayWork::kSegments + 1> position_;
  std::array<std::uint64_t, RayWork::kSegments / 64> has_hit_;
};

#endif

/// Queries segments in chunks, on all threads. @param query  called with a chunk's first and last index, and hits.
template <class Query>
void queryInChunks(std::size_t count, const Query& query, Hits& hits) {
  constexpr std::size_t kChunk = 8192;
#ifdef SDF_CCD_HIGHWAY
  static_assert(kChunk == RayWork::kSegments, "a chunk fills one thread's room");
#endif
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  if (chunks <= 1 || tbb::this_task_arena::max_concurrency() == 1) {
    for (std::size_t i = 0; i < chunks; ++i) {
      checkCancelled();
      query(i * kChunk, std::min(count, (i + 1) * kChunk), hits);
    }
    return;
  }
  std::vector<Hits> found(chunks);
  const CancelPoint cancel;
  const auto queryChunk = [&](std::size_t i) {
    cancel.check();
    query(i * kChunk, std::min(count, (i + 1) * kChunk), found[i]);
  };
  // Isolated: while it waits, this thread must not begin other work of the caller's that shares its memory.
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, chunks, queryChunk); });
  for (const Hits& some : found) hits.insert(hits.end(), some.begin(), some.end());
}

/// All hits, even if only the first intervals are needed.
void queryAll(const DistanceField& field, const Segment* segments, std::size_t count, const SegmentOptions& options,
              Hits& hits) {
#ifdef SDF_CCD_HIGHWAY
  const auto queryLanes = [&](const auto& lanes) {
    const auto query = [&](std::size_t first, std::size_t last, Hits& found) {
      thread_local const std::unique_ptr<Chunk> rays = std::make_unique<Chunk>();
      rays->query(field, lanes, segments, first, static_cast<int>(last - first), options, found);
    };
    queryInChunks(count, query, hits);
  };
  if (const AdaptiveGrid* grid = FieldAccess::adaptive(field)) return queryLanes(AdaptiveLanes(*grid, options.sigma));
  if (const SparseGrid* grid = FieldAccess::grid(field)) return queryLanes(UniformLanes(*grid, options.sigma));
#endif
  const auto query = [&](std::size_t first, std::size_t last, Hits& found) {
    querySingly(field, segments, first, last, options, found);
  };
  queryInChunks(count, query, hits);
}

}  // namespace

void segmentIntervals(const DistanceField& field, const Segment* segments, std::size_t count,
                      const SegmentOptions& options, BatchResult& result) {
  checkIsovalue(field, options.sigma);
  Hits& hits = result.hits;
  hits.clear();
  queryAll(field, segments, count, options, hits);
  if (options.mode == SegmentMode::kFirstInterval) {
    const auto same = [](const SegmentHit& a, const SegmentHit& b) { return a.segment == b.segment; };
    hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  }
}

}  // namespace sdf_ccd
