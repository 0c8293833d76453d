// Vector code that is compiled once for each kind of processor; the best one is chosen when the program runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "adaptive_lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <utility>

#include "adaptive_lanes.h"
#include "cell_cubic.h"
#include "lane_leaves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

class Follower {
 public:
  Follower(const LaneGrid& grid, bool first_only, Flight& flight, FlightWork& work)
      : g_(grid), first_only_(first_only), flight_(flight), work_(work) {}

  void run(int count) {
    for (int i = 0; i < count; ++i) work_.moving[i] = i;
    int moving = count;
    // Each pass takes every flight through a cell at least; none meets more than this.
    const int most = 4 * AdaptiveShape::kUnits * (g_.top_size[0] + g_.top_size[1] + g_.top_size[2]);
    for (int pass = 0; moving > 0; ++pass) {
      if (pass == most) {
        work_.lost.assign(work_.moving.begin(), work_.moving.begin() + moving);
        return;
      }
      next_ = at_leaf_ = at_node_ = 0;
      for (int i = 0; i < moving; i += 2 * int(hn::Lanes(f))) move(i, moving - i);
      for (int i = 0; i < at_node_; i += 2 * int(hn::Lanes(f))) descend(i, at_node_ - i);
      for (int i = 0; i < at_leaf_; i += int(hn::Lanes(f))) cross(i, at_leaf_ - i);
      std::swap(work_.moving, work_.spare);
      moving = next_;
    }
  }

 private:
  void hit(std::int32_t index, float enter, float exit) {
    work_.hits.push_back({static_cast<std::uint32_t>(index), enter, exit});
  }

  /// Lanes found to be inside (or outside) from t on, and not before: begins or ends their hits.
  /// @return lanes that are done with.
  MI turn(MI inside, MI of, VF t, VI index, Lanes& lanes) {
    const MI was = asWhole(hn::Ge(lanes.enter, real(0.0F)));
    const MI begin = hn::And(of, hn::AndNot(was, inside)), end = hn::And(of, hn::AndNot(inside, was));
    if (!hn::AllFalse(n, end)) {
      const Unpacked<float> enters(lanes.enter), exits(t);
      const Unpacked<std::int32_t> ids(index);
      forEach(end, [&](std::size_t i) { hit(ids[i], enters[i], exits[i]); });
      lanes.enter = hn::IfThenElse(asReal(end), real(-1.0F), lanes.enter);
    }
    if (hn::AllFalse(n, begin)) return begin;
    if (first_only_) {
      const Unpacked<float> enters(t);
      const Unpacked<std::int32_t> ids(index);
      forEach(begin, [&](std::size_t i) { hit(ids[i], enters[i], enters[i]); });
      return begin;
    }
    lanes.enter = hn::IfThenElse(asReal(begin), t, lanes.enter);
    return none();
  }

  /// Ends the hits of lanes that end inside.
  void finish(MI done, VI index, const Lanes& lanes) {
    const MI inside = hn::And(done, asWhole(hn::Ge(lanes.enter, real(0.0F))));
    if (hn::AllFalse(n, inside)) return;
    const Unpacked<float> enters(lanes.enter);
    const Unpacked<std::int32_t> ids(index);
    forEach(inside, [&](std::size_t i) { hit(ids[i], enters[i], 1.0F); });
  }

  void store(MI which, VI index, const Lanes& lanes, FlightList& list, int& size) {
    const Unpacked<std::int32_t> ids(index), x(lanes.cell[0]), y(lanes.cell[1]), z(lanes.cell[2]);
    const Unpacked<float> t(lanes.t), enter(lanes.enter);
    forEach(which, [&](std::size_t i) {
      const std::int32_t id = ids[i];
      flight_.cell[0][id] = x[i];
      flight_.cell[1][id] = y[i];
      flight_.cell[2][id] = z[i];
      flight_.t[id] = t[i];
      flight_.enter[id] = enter[i];
      list[size++] = id;
    });
  }

  /// A vector of flights that are moved together.
  struct Moving {
    VI index;
    Lanes lanes;
    VF length2, inverse2;
    MI live;            ///< still on their way
    MI at_leaf;         ///< have come to one
    MI at_node;         ///< of a top cell; below one: have left its top cell
    VI leaf, log_side;  ///< where they have come to; below a node: the node

    Moving(const Flight& flight, MI used, VI numbers)
        : index(numbers),
          lanes(flight, numbers),
          live(used),
          at_leaf(none()),
          at_node(none()),
          leaf(hn::Zero(n)),
          log_side(hn::Zero(n)) {
      length2 = hn::MulAdd(lanes.d[0], lanes.d[0], hn::MulAdd(lanes.d[1], lanes.d[1], hn::Mul(lanes.d[2], lanes.d[2])));
      inverse2 = hn::Div(real(1.0F), hn::Max(length2, real(1e-30F)));
    }
  };

  Moving take(const FlightList& list, int first, int left) const {
    const MI used = hn::FirstN(n, std::size_t(std::max(left, 0)));
    const int begin = std::min(first, Flight::kCapacity);
    return {flight_, used, hn::IfThenElseZero(used, hn::LoadU(n, list.data() + begin))};
  }

  /// Through the top grid: from ball to ball, and from one far cell to the next, until most lanes are at a leaf, at a
  /// node or done. Two vectors at a time: while one waits for memory the other goes on.
  void move(int first, int left) {
    const int lanes = int(hn::Lanes(f));
    Moving a = take(work_.moving, first, left), b = take(work_.moving, first + lanes, left - lanes);
    const std::size_t few = hn::Lanes(f) / 2;
    int steps = 0;
    do {
      const Blocks at_a = locateTop(g_, a.lanes.cell), at_b = locateTop(g_, b.lanes.cell);
      step(at_a, a);
      step(at_b, b);
    } while (hn::CountTrue(n, a.live) + hn::CountTrue(n, b.live) > few && ++steps < 4096);
    put(a);
    put(b);
    for (Moving* m : {&a, &b}) {
      if (hn::AllFalse(n, m->at_node)) continue;
      const Unpacked<std::int32_t> ids(m->index), nodes(m->leaf);
      forEach(m->at_node, [&](std::size_t i) {
        hwy::Prefetch(g_.codes + 16 * std::size_t(nodes[i]));
        flight_.leaf[ids[i]] = nodes[i];
      });
      store(m->at_node, m->index, m->lanes, work_.at_node, at_node_);
    }
  }

  /// The same below the nodes of top cells, until most lanes have left their top cell.
  void descend(int first, int left) {
    const int lanes = int(hn::Lanes(f));
    Moving a = take(work_.at_node, first, left), b = take(work_.at_node, first + lanes, left - lanes);
    const VI node_a = hn::GatherIndex(n, flight_.leaf.data(), a.index);
    const VI node_b = hn::GatherIndex(n, flight_.leaf.data(), b.index);
    const std::size_t few = hn::Lanes(f) / 2;
    int steps = 0;
    do {
      descendOnce(hn::IfThenElseZero(a.live, node_a), a);
      descendOnce(hn::IfThenElseZero(b.live, node_b), b);
    } while (hn::CountTrue(n, a.live) + hn::CountTrue(n, b.live) > few && ++steps < 4096);
    put(a);
    put(b);
    for (Moving* m : {&a, &b}) {
      if (!hn::AllFalse(n, m->at_node)) store(m->at_node, m->index, m->lanes, work_.spare, next_);
    }
  }

  void descendOnce(VI node, Moving& m) {
    const auto topOf = [&](int k) { return hn::ShiftRight<kLogTop>(m.lanes.cell[k]); };
    const VI before[3] = {topOf(0), topOf(1), topOf(2)};
    step(locateBelow(g_, m.lanes.cell, node), m);
    const MI stays =
        hn::And(hn::Eq(before[0], topOf(0)), hn::And(hn::Eq(before[1], topOf(1)), hn::Eq(before[2], topOf(2))));
    m.at_node = hn::Or(m.at_node, hn::AndNot(stays, m.live));
    m.live = hn::And(m.live, stays);
  }

  void step(const Blocks& block, Moving& m) {
    Lanes& lanes = m.lanes;
    const MI arrived = hn::AndNot(block.far, m.live);
    m.leaf = hn::IfThenElse(arrived, block.leaf, m.leaf);
    m.log_side = hn::IfThenElse(arrived, block.log_side, m.log_side);
    m.at_node = hn::Or(m.at_node, hn::And(arrived, block.node));
    m.at_leaf = hn::Or(m.at_leaf, hn::AndNot(block.node, arrived));
    m.live = hn::And(m.live, block.far);
    if (hn::AllFalse(n, m.live)) return;
    const MI inside = asWhole(hn::Lt(block.radius, real(0.0F)));
    m.live = hn::AndNot(turn(inside, m.live, lanes.t, m.index, lanes), m.live);

    const Exits exits = exitsOf(lanes, block.log_side);
    // The ball about the block's centre, seen from where the lane is: small numbers, so that little is rounded.
    const VF half = hn::Mul(hn::ConvertTo(f, exits.side), real(0.5F));
    VF b = real(0.0F), c = real(0.0F);
    for (int k = 0; k < 3; ++k) {
      const VF at = hn::MulAdd(lanes.d[k], lanes.t, lanes.o[k]);
      const VF from = hn::Sub(at, hn::Add(hn::ConvertTo(f, exits.low[k]), half));
      b = hn::MulAdd(from, lanes.d[k], b);
      c = hn::MulAdd(from, from, c);
    }
    const VF radius = hn::Sub(hn::MulAdd(hn::Abs(block.radius), real(1.0F - 1e-5F), real(-0.01F)), real(g_.margin));
    const VF excess = hn::NegMulAdd(radius, radius, c);
    const VF discriminant = hn::NegMulAdd(m.length2, excess, hn::Mul(b, b));
    const VF root = hn::Sqrt(hn::Max(discriminant, real(0.0F)));
    const VF t_ball = hn::MulAdd(hn::Sub(root, b), m.inverse2, lanes.t);
    const MF jump = hn::And(hn::And(hn::Lt(excess, real(0.0F)), hn::Gt(radius, real(0.0F))), hn::Gt(t_ball, exits.t));
    const VF t = hn::IfThenElse(jump, t_ball, exits.t);
    MI done = hn::And(m.live, asWhole(hn::Ge(t, real(1.0F))));
    done = hn::Or(done, advance(g_, exits, jump, t, m.live, lanes));
    finish(done, m.index, lanes);
    m.live = hn::AndNot(done, m.live);
  }

  void put(const Moving& m) {
    if (!hn::AllFalse(n, m.at_leaf)) {
      const Unpacked<std::int32_t> ids(m.index), leaves(m.leaf), sides(m.log_side);
      forEach(m.at_leaf, [&](std::size_t i) {
        const std::int32_t leaf = leaves[i];
        hwy::Prefetch(leaf >= Flight::kSplit ? g_.splits + 2 * (leaf - Flight::kSplit) : g_.leaves + 2 * leaf);
        flight_.leaf[ids[i]] = leaf;
        flight_.log_side[ids[i]] = sides[i];
      });
      store(m.at_leaf, m.index, m.lanes, work_.at_leaf, at_leaf_);
    }
    if (!hn::AllFalse(n, m.live)) store(m.live, m.index, m.lanes, work_.spare, next_);
  }

  /// Through a leaf.
  void cross(int first, int left) {
    const MI used = hn::FirstN(n, std::size_t(left));
    const VI index = hn::IfThenElseZero(used, hn::LoadU(n, work_.at_leaf.data() + first));
    Lanes lanes(flight_, index);
    const VI leaf = hn::IfThenElseZero(used, hn::GatherIndex(n, flight_.leaf.data(), index));
    const VI log_side = hn::IfThenElseZero(used, hn::GatherIndex(n, flight_.log_side.data(), index));
    const Exits exits = exitsOf(lanes, log_side);
    const VF t_exit = hn::Min(exits.t, real(1.0F));

    const Crossing crossing = crossingOf(leafSteps(g_, used, leaf, log_side), lanes, exits, t_exit);
    const MI in_start = asWhole(crossing.in_start), in_end = asWhole(crossing.in_end);
    const MI hard = hn::And(used, asWhole(crossing.hard));
    const MI easy = hn::AndNot(hard, used);
    // A sign that differs from the last block's changes at the face.
    MI over = turn(in_start, easy, lanes.t, index, lanes);
    const MI rest = hn::And(hn::AndNot(over, easy), hn::Xor(in_start, in_end));
    over = hn::Or(over, turn(in_end, rest, crossing.t_root, index, lanes));
    if (!hn::AllFalse(n, hard)) {
      const Unpacked<std::int32_t> ids(index);
      const Unpacked<float> k0(crossing.c[0]), k1(crossing.c[1]), k2(crossing.c[2]), k3(crossing.c[3]), starts(lanes.t),
          ends(t_exit);
      Unpacked<float> enters(lanes.enter);
      Unpacked<std::int32_t> overs(hn::Zero(n));
      forEach(hard, [&](std::size_t i) {
        const CellCubic cubic{{double(k0[i]), double(k1[i]), double(k2[i]), double(k3[i])}};
        overs.value[i] = hardLeaf(cubic, ids[i], starts[i], ends[i], enters.value[i]) ? -1 : 0;
      });
      lanes.enter = hn::Load(f, enters.value);
      over = hn::Or(over, hn::Ne(hn::Load(n, overs.value), hn::Zero(n)));
    }
    const MI going = hn::AndNot(over, used);
    MI done = hn::And(going, asWhole(hn::Ge(exits.t, real(1.0F))));
    done = hn::Or(done, advance(g_, exits, asReal(none()), exits.t, going, lanes));
    finish(done, index, lanes);
    const MI onward = hn::AndNot(done, going);
    if (!hn::AllFalse(n, onward)) store(onward, index, lanes, work_.spare, next_);
  }

  /// A leaf with several roots, by the exact method. @return true if the flight is done with.
  bool hardLeaf(const CellCubic& cubic, std::int32_t id, float start, float end, float& enter) {
    const CellIntervals found = nonPositive(cubic);
    const auto timeOf = [&](double u) { return static_cast<float>(start + u * (double(end) - double(start))); };
    const bool at_start = found.count > 0 && found.interval[0].enter == 0.0;
    if (enter >= 0.0F && !at_start) {
      hit(id, enter, start);
      enter = -1.0F;
    }
    for (int i = 0; i < found.count; ++i) {
      const Interval& span = found.interval[i];
      if (enter < 0.0F) enter = timeOf(span.enter);
      if (first_only_) {
        hit(id, enter, enter);
        return true;
      }
      if (span.exit == 1.0) return false;
      hit(id, enter, timeOf(span.exit));
      enter = -1.0F;
    }
    return false;
  }

  const LaneGrid& g_;
  bool first_only_;
  Flight& flight_;
  FlightWork& work_;
  int next_ = 0, at_leaf_ = 0, at_node_ = 0;  ///< entries of work_.spare, at_leaf and at_node
};

}  // namespace

void follow(const LaneGrid& grid, bool first_only, int count, Flight& flight, FlightWork& work) {
  Follower(grid, first_only, flight, work).run(count);
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf_ccd {

HWY_EXPORT(follow);

void followFlights(const LaneGrid& grid, bool first_only, int count, Flight& flight, FlightWork& work) {
  work.hits.clear();
  work.lost.clear();
  HWY_DYNAMIC_DISPATCH(follow)(grid, first_only, count, flight, work);
}

}  // namespace sdf_ccd
#endif
