// Vector code that is compiled once for each kind of processor; the best one is chosen when the program runs.
// Not for targets whose vectors have a size unknown to the compiler: here vectors are members of structs.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/lanes/segment_lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "lane_adaptive-inl.h"
#include "lane_uniform-inl.h"
#include "query/cells/cell_cubic.h"
#include "query/prefetch.h"
#include "segment_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// Segments wait in queues for the memory that their next step reads: a top cell's word, a node's code, a leaf. A pass
/// reads it for all of a queue, then takes the queue's rays one step further in vectors.
/// @tparam first_only  a segment is complete where its first hit begins.
template <class Grid, bool first_only>
class Follower {
 public:
  Follower(const Grid& grid, RayWork& work) : g_(grid), work_(work) {}

  int run(const Segment* segments, int count) {
    work_.hits.size = 0;
    work_.unfinished.clear();
    for (Queues* queues : {&work_.top, &work_.node}) (*queues)[0].size = (*queues)[1].size = 0;
    work_.leaf.size = 0;
    // Each pass takes each ray through a cell; no ray crosses more cells than this.
    const int max_passes = 4 * LaneBox::kUnits * (g_.top_size[0] + g_.top_size[1] + g_.top_size[2]);
    int enqueued = 0, last_active = 0;
    for (int pass = 0; pass < max_passes; ++pass) {
      enqueued = enqueue(segments, enqueued, count);
      if (refused_ >= 0) return refused_;
      const int active = this->active();
      if (active == 0 && enqueued >= count) return -1;
      if (active != last_active) pass = 0;
      last_active = active;
      next_ ^= 1;
      RayQueue &top = work_.top[next_ ^ 1], &node = work_.node[next_ ^ 1], &leaf = work_.leaf;
      fetchTop(g_, top.index.data(), top.size, work_.fetched.word.data());
      takeAll(top, [&](Lanes& lanes, MI used, int first) { crossTop(lanes, used, first, node); });
      fetchBelow(g_, node, work_.fetched);
      takeAll(node, [&](Lanes& lanes, MI used, int first) { descend(g_, lanes, used, first); });
      fetchLeaves(g_, leaf, work_.fetched);
      takeAll(leaf, [&](Lanes& lanes, MI used, int first) { crossLeaf(lanes, used, first); });
    }
    for (Queues* queues : {&work_.top, &work_.node}) {
      const RayQueue& queue = (*queues)[next_];
      work_.unfinished.insert(work_.unfinished.end(), queue.id.begin(), queue.id.begin() + queue.size);
    }
    return -1;
  }

 private:
  using Queues = std::array<RayQueue, 2>;

  int active() const { return work_.top[next_].size + work_.node[next_].size + work_.leaf.size; }

  template <class Step>
  void takeAll(RayQueue& queue, const Step& step) {
    const int width = static_cast<int>(hn::Lanes(f));
    for (int i = 0; i < queue.size; i += width) {
      const MI used = hn::FirstN(n, static_cast<std::size_t>(queue.size - i));
      Lanes lanes(queue, i, used);
      if constexpr (!first_only) lanes.enter = hn::LoadU(f, queue.enter.data() + i);
      step(lanes, used, i);
    }
    queue.size = 0;
  }

  /// Enqueues as many segments as fit, from index `first` on. @return the first one that is not enqueued; `count` if
  /// one is refused, after which no result counts.
  int enqueue(const Segment* segments, int first, int count) {
    while (first < count && RayQueue::kCapacity - active() >= BoxEntry::kMaxSegments) {
      const int group = std::min(BoxEntry::kMaxSegments, count - first);
      const BoxEntry entry(g_, segments + first, group, work_.begin.data() + first, work_.end.data() + first);
      if (entry.doubtful) {
        const auto within = [](const Segment& s) { return isWithinReach(s); };
        const int found = int(std::find_if_not(segments + first, segments + first + group, within) - segments);
        if (found < first + group) {
          refused_ = found;
          return count;
        }
      }
      dispatch(entry, segments, first, group);
      first += group;
    }
    return first;
  }

  /// A group's first step: it completes most short segments.
  void dispatch(const BoxEntry& entry, const Segment* segments, int first, int count) {
    const int width = static_cast<int>(hn::Lanes(f));
    HWY_ALIGN std::int32_t cell[3][BoxEntry::kMaxSegments], word[BoxEntry::kMaxSegments];
    for (int i = 0; i < count; i += width) {
      Lanes lanes(entry, i, first);
      findCells(g_, lanes);
      for (int k = 0; k < 3; ++k) hn::StoreU(lanes.cell[k], n, cell[k] + i);
      hn::StoreU(topIndex(g_, lanes.cell), n, word + i);
    }
    fetchTop(g_, word, count, word);
    for (int i = 0; i < count; i += width) {
      Lanes lanes(entry, i, first);
      for (int k = 0; k < 3; ++k) lanes.cell[k] = hn::LoadU(n, cell[k] + i);
      // Prefetches the segments to enqueue next and, as they may be in slow memory, some of those after them.
      prefetch(segments + first + count + i, static_cast<std::size_t>(width));
      prefetch<CacheLevel::kSecond>(segments + first + 4 * count + i, static_cast<std::size_t>(width));
      const MI in_box = asWhole(hn::Le(hn::LoadU(f, entry.t0 + i), hn::LoadU(f, entry.t1 + i)));
      const MI used = hn::And(in_box, hn::FirstN(n, static_cast<std::size_t>(count - i)));
      sort(locateTop(g_, hn::LoadU(n, word + i), lanes.cell), lanes, used, work_.node[next_]);
    }
  }

  /// Begins or ends the hits of those lanes `of` whose side changes at t.
  /// @param inside  lanes that are inside from t on.
  /// @return lanes that are complete.
  HWY_INLINE MI flip(MI inside, MI of, VF t, Lanes& lanes) {
    if constexpr (first_only) {
      const MI begin = hn::And(of, inside);
      if (!hn::AllFalse(n, begin)) append(begin, lanes.id, t, t, work_.hits);
      return begin;
    }
    const MI was = asWhole(hn::Ge(lanes.enter, real(0.0F)));
    const MI begin = hn::And(of, hn::AndNot(was, inside)), end = hn::And(of, hn::AndNot(inside, was));
    // Where a hit is as short as rounding, t may be the earlier one.
    if (!hn::AllFalse(n, end)) append(end, lanes.id, lanes.enter, hn::Max(t, lanes.enter), work_.hits);
    lanes.enter = hn::IfThenElse(asReal(end), real(-1.0F), hn::IfThenElse(asReal(begin), t, lanes.enter));
    return none();
  }

  /// Ends the hits of lanes that end inside.
  HWY_INLINE void finish(MI done, const Lanes& lanes) {
    if constexpr (first_only) return;
    const MI inside = hn::And(done, asWhole(hn::Ge(lanes.enter, real(0.0F))));
    if (!hn::AllFalse(n, inside)) append(inside, lanes.id, lanes.enter, real(1.0F), work_.hits);
  }

  /// Puts lanes into a queue.
  HWY_INLINE void wait(MI which, const Lanes& lanes, VI index, VI log_side, RayQueue& queue) {
    append<!first_only>(which, lanes, index, log_side, queue);
  }

  /// Enqueues lanes that have entered a top cell.
  HWY_INLINE void enterTop(const Lanes& lanes, MI which) {
    if (hn::AllFalse(n, which)) return;
    wait(which, lanes, topIndex(g_, lanes.cell), lanes.log_side, work_.top[next_]);
  }

  /// The same for lanes that come from other cells: those that stay in their brick need no look-up of its word.
  HWY_INLINE void enterTopFrom(const VI* from, const Lanes& lanes, MI which) {
    if constexpr (std::is_same_v<Grid, UniformLanes>) {
      VI changed = hn::Zero(n);
      for (int k = 0; k < 3; ++k) changed = hn::Or(changed, hn::Xor(from[k], lanes.cell[k]));
      const MI same_brick = hn::And(which, hn::Lt(changed, whole(LaneBox::kUnits)));
      if (!hn::AllFalse(n, same_brick)) {
        wait(same_brick, lanes, lanes.index, whole(LaneBox::kLogUnits), work_.node[next_]);
      }
      which = hn::AndNot(same_brick, which);
    }
    enterTop(lanes, which);
  }

  /// According to the top cell's word: passes a far cell, or enqueues the lane for the cell's content.
  HWY_INLINE void crossTop(Lanes& lanes, MI used, int first, RayQueue& nodes) {
    const Blocks at = locateTop(g_, hn::LoadU(n, work_.fetched.word.data() + first), lanes.cell);
    sort(at, lanes, used, nodes);
  }

  /// Passes far blocks; enqueues the lanes at other blocks.
  HWY_INLINE void sort(const Blocks& at, Lanes& lanes, MI used, RayQueue& nodes) {
    const MI far = hn::And(used, at.far), node = hn::And(used, at.node);
    const MI leaf = hn::AndNot(hn::Or(at.far, at.node), used);
    if (!hn::AllFalse(n, node)) wait(node, lanes, at.index, at.log_side, nodes);
    if (!hn::AllFalse(n, leaf)) wait(leaf, lanes, at.index, at.log_side, work_.leaf);
    if (!hn::AllFalse(n, far)) enterTop(lanes, passFar(lanes, at, far));
  }

  /// The parameters at which lanes leave spheres that contain them; t where a sphere does not. Computed relative to the
  /// lanes' positions: such coordinates are small, and so are their rounding errors.
  static HWY_INLINE VF ballExit(const Lanes& lanes, const VF* center, VF radius2) {
    VF b = real(0.0F), c = real(0.0F), length2 = real(1e-20F);
    for (int k = 0; k < 3; ++k) {
      const VF from = hn::Sub(lanes.at(k), center[k]);
      b = hn::MulAdd(from, lanes.d[k], b);
      c = hn::MulAdd(from, from, c);
      length2 = hn::MulAdd(lanes.d[k], lanes.d[k], length2);
    }
    const VF excess = hn::Sub(c, radius2);
    const VF discriminant = hn::NegMulAdd(length2, excess, hn::Mul(b, b));
    const VF exit = hn::Div(hn::Sub(hn::Sqrt(hn::Max(discriminant, real(0.0F))), b), length2);
    return hn::IfThenElse(hn::Lt(excess, real(0.0F)), hn::Add(exit, lanes.t), lanes.t);
  }

  /// Moves lanes to t: to any cell (`jump`), or through their exit. @return lanes that are not complete.
  HWY_INLINE MI moveOn(Lanes& lanes, const Exits& exits, MF jump, VF t, MI live) {
    const MI ended = hn::And(live, asWhole(hn::Ge(t, real(1.0F))));
    const MI done = hn::Or(ended, advance(g_, exits, jump, t, live, lanes));
    finish(done, lanes);
    return hn::AndNot(done, live);
  }

  /// Passes far blocks: to the exit from the empty sphere, or from the block.
  /// @return lanes that are neither complete nor hit; they are in their new cells.
  HWY_INLINE MI passFar(Lanes& lanes, const Blocks& at, MI live) {
    live = hn::AndNot(flip(at.inside, live, lanes.t, lanes), live);
    const VI side = hn::Shl(whole(1), at.log_side), mask = hn::Neg(side);
    const VF half = hn::Mul(hn::ConvertTo(f, side), real(0.5F));
    const VF rounded = hn::MulAdd(at.radius, real(1.0F - 1e-5F), real(-0.01F));
    const VF radius = hn::Max(hn::Sub(rounded, real(g_.margin)), real(0.0F)), radius2 = hn::Mul(radius, radius);
    VF center[3], farthest2 = real(0.0F);  // squared distance from it to the block's farthest corner
    for (int k = 0; k < 3; ++k) {
      center[k] = hn::Add(hn::ConvertTo(f, hn::And(lanes.cell[k], mask)), at.ball[k]);
      const VF to_corner = hn::Add(hn::Abs(hn::Sub(at.ball[k], half)), half);
      farthest2 = hn::MulAdd(to_corner, to_corner, farthest2);
    }
    const VF t_ball = ballExit(lanes, center, radius2);
    // A sphere that contains all of the block is left later than the block.
    const MI covered = asWhole(hn::Gt(radius2, hn::Mul(farthest2, real(1.001F))));
    if (hn::AllFalse(n, hn::AndNot(covered, live))) {
      const MI done = hn::And(live, asWhole(hn::Ge(t_ball, real(1.0F))));
      finish(done, lanes);
      const MI onward = hn::AndNot(done, live);
      if (hn::AllFalse(n, onward)) return onward;
      lanes.t = t_ball;
      findCells(g_, lanes);
      return onward;
    }
    const Exits exits = exitsOf(lanes, at.log_side);
    // Covered lanes jump here too, so that their result does not depend on their neighbours.
    const MF jump = hn::Or(asReal(covered), hn::Gt(t_ball, exits.t));
    return moveOn(lanes, exits, jump, hn::IfThenElse(jump, t_ball, exits.t), live);
  }

  /// Descends one level, according to the node's code for the lane's child.
  HWY_INLINE void descend(const AdaptiveLanes& grid, Lanes& lanes, MI used, int first) {
    sort(locateBelow(grid, lanes, work_.fetched, first), lanes, used, work_.node[next_]);
  }

  /// In a brick: advances through the sphere about the nearest sample if that leaves the cell; else enqueues the cell.
  HWY_INLINE void descend(const UniformLanes& grid, Lanes& lanes, MI used, int first) {
    const VI log_cell = whole(UniformLanes::kLogCell);
    const SampleBall ball = nearestBall(grid, lanes, work_.fetched, first);
    const VF t_ball = ballExit(lanes, ball.center, ball.radius2);
    const Exits exits = exitsOf(lanes, log_cell);
    const MF jump = hn::Gt(t_ball, exits.t);
    const MI leaf = hn::AndNot(asWhole(jump), used);
    MI far = hn::And(used, asWhole(jump));
    if (!hn::AllFalse(n, leaf)) wait(leaf, lanes, lanes.index, log_cell, work_.leaf);
    if (hn::AllFalse(n, far)) return;
    far = hn::AndNot(flip(ball.inside, far, lanes.t, lanes), far);
    const VI from[3] = {lanes.cell[0], lanes.cell[1], lanes.cell[2]};
    const MI onward = moveOn(lanes, exits, jump, t_ball, far);
    enterTopFrom(from, lanes, onward);
  }

  HWY_INLINE void crossLeaf(Lanes& lanes, MI used, int first) {
    const Exits exits = exitsOf(lanes, lanes.log_side);
    const VF t_exit = hn::Min(exits.t, real(1.0F));
    const LeafCorners corners = leafCorners(g_, lanes, work_.fetched, first);
    const Crossing crossing = crossingOf(corners, lanes, exits, t_exit);
    const MI in_start = asWhole(crossing.in_start), in_end = asWhole(crossing.in_end);
    const MI hard = hn::And(used, asWhole(crossing.hard));
    const MI easy = hn::AndNot(hard, used);
    // If the sign differs from the last block's, it changes at the face.
    MI over = flip(in_start, easy, lanes.t, lanes);
    const MI rest = hn::And(hn::AndNot(over, easy), hn::Xor(in_start, in_end));
    over = hn::Or(over, flip(in_end, rest, crossing.t_root, lanes));
    if (!hn::AllFalse(n, hard)) over = hn::Or(over, solveLeavesExactly(crossing, hard, t_exit, lanes));
    const MI going = hn::AndNot(over, used);
    // Through the face, or to the exit from the empty sphere about the exit point, whose radius is the leaf's value.
    VF length2 = real(1e-20F);
    for (int k = 0; k < 3; ++k) length2 = hn::MulAdd(lanes.d[k], lanes.d[k], length2);
    const VF free = hn::MulSub(hn::Abs(crossing.at_end), corners.step, real(g_.leaf_margin));
    const VF t_free = hn::Add(hn::Div(free, hn::Sqrt(length2)), exits.t);
    // A step below one unit could be lost in rounding and leave the lane in its cell for ever.
    const MF jump = hn::And(hn::Gt(free, real(1.0F)), hn::Gt(t_free, exits.t));
    const VI from[3] = {lanes.cell[0], lanes.cell[1], lanes.cell[2]};
    const MI onward = moveOn(lanes, exits, jump, hn::IfThenElse(jump, t_free, exits.t), going);
    enterTopFrom(from, lanes, onward);
  }

  /// @return lanes that are complete.
  MI solveLeavesExactly(const Crossing& crossing, MI hard, VF t_exit, Lanes& lanes) {
    const Unpacked<std::int32_t> ids(lanes.id);
    const Unpacked<float> k0(crossing.c[0]), k1(crossing.c[1]), k2(crossing.c[2]), k3(crossing.c[3]), starts(lanes.t),
        ends(t_exit);
    Unpacked<float> enters(lanes.enter);
    Unpacked<std::int32_t> overs(hn::Zero(n));
    forEach(hard, [&](std::size_t i) {
      const CellCubic cubic{{double(k0[i]), double(k1[i]), double(k2[i]), double(k3[i])}};
      overs.value[i] = solveLeafExactly(cubic, ids[i], starts[i], ends[i], enters.value[i]) ? -1 : 0;
    });
    lanes.enter = hn::Load(f, enters.value);
    return hn::Ne(hn::Load(n, overs.value), hn::Zero(n));
  }

  /// Crosses a leaf with several roots by the exact method. @return whether the ray is complete.
  bool solveLeafExactly(const CellCubic& cubic, std::int32_t id, float start, float end, float& enter) {
    const CellIntervals found = nonPositive(cubic);
    const auto timeOf = [&](double u) { return static_cast<float>(start + u * (double(end) - double(start))); };
    const bool at_start = found.count > 0 && found.interval[0].enter == 0.0;
    if (enter >= 0.0F && !at_start) {
      work_.hits.add(id, enter, std::max(enter, start));
      enter = -1.0F;
    }
    for (int i = 0; i < found.count; ++i) {
      const Interval& span = found.interval[i];
      if (enter < 0.0F) enter = timeOf(span.enter);
      if (first_only) {
        work_.hits.add(id, enter, enter);
        return true;
      }
      if (span.exit == 1.0) return false;
      work_.hits.add(id, enter, std::max(enter, timeOf(span.exit)));
      enter = -1.0F;
    }
    return false;
  }

  const Grid& g_;
  RayWork& work_;
  int refused_ = -1;  ///< index of a segment that is not within reach
  int next_ = 0;      ///< in each pair of queues, the index of the one being written
};

}  // namespace

int followAdaptive(const AdaptiveLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work) {
  return first_only ? Follower<AdaptiveLanes, true>(grid, work).run(segments, count)
                    : Follower<AdaptiveLanes, false>(grid, work).run(segments, count);
}

int followUniform(const UniformLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work) {
  return first_only ? Follower<UniformLanes, true>(grid, work).run(segments, count)
                    : Follower<UniformLanes, false>(grid, work).run(segments, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf_ccd {

HWY_EXPORT(followAdaptive);
HWY_EXPORT(followUniform);

int followRays(const AdaptiveLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work) {
  return HWY_DYNAMIC_DISPATCH(followAdaptive)(grid, first_only, segments, count, work);
}

int followRays(const UniformLanes& grid, bool first_only, const Segment* segments, int count, RayWork& work) {
  return HWY_DYNAMIC_DISPATCH(followUniform)(grid, first_only, segments, count, work);
}

}  // namespace sdf_ccd
#endif
