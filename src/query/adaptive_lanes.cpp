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

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;
using MI = hn::Mask<I>;

constexpr F f;
constexpr I n;
constexpr int kLogTop = 7;  // of AdaptiveShape::kUnits

inline VF real(float v) {
  return hn::Set(f, v);
}
inline VI whole(std::int32_t v) {
  return hn::Set(n, v);
}
inline MF asReal(MI m) {
  return hn::RebindMask(f, m);
}
inline MI asWhole(MF m) {
  return hn::RebindMask(n, m);
}

inline MI none() {
  return hn::FirstN(n, 0);
}

inline VI gather(const std::uint32_t* base, VI index) {
  return hn::GatherIndex(n, reinterpret_cast<const std::int32_t*>(base), index);
}

template <class T>
inline VF gatherReal(const T& column, VI index) {
  return hn::GatherIndex(f, column.data(), index);
}

/// The lanes' segments.
struct Lanes {
  VF o[3], d[3];
  VI cell[3];
  VF t, enter;

  Lanes(const Flight& flight, VI index) {
    for (int k = 0; k < 3; ++k) {
      o[k] = gatherReal(flight.o[k], index);
      d[k] = gatherReal(flight.d[k], index);
      cell[k] = hn::GatherIndex(n, flight.cell[k].data(), index);
    }
    t = gatherReal(flight.t, index);
    enter = gatherReal(flight.enter, index);
  }
};

/// The block that each lane is in.
struct Blocks {
  VI log_side;
  VI leaf;    ///< index; of a top cell's node where `node`
  VF radius;  ///< where `far`: signed distance of the surface from the centre [units]
  MI far;
  MI node;  ///< to be asked further, with locateBelow()
};

/// Which of its eight halves each lane is in.
inline VI halfOf(const VI* cell, VI log_half) {
  const VI one = whole(1);
  const auto bit = [&](VI c) { return hn::And(hn::Shr(c, log_half), one); };
  return hn::Or(bit(cell[0]), hn::Or(hn::ShiftLeft<1>(bit(cell[1])), hn::ShiftLeft<2>(bit(cell[2]))));
}

inline void enterSplits(MI split, const VI* cell, Blocks& b) {
  if (hn::AllFalse(n, split)) return;
  b.log_side = hn::IfThenElse(split, hn::Sub(b.log_side, whole(1)), b.log_side);
  const VI leaf = hn::Add(hn::Add(hn::ShiftLeft<3>(b.leaf), halfOf(cell, b.log_side)), whole(Flight::kSplit));
  b.leaf = hn::IfThenElse(split, leaf, b.leaf);
}

/// By the top grid alone.
inline Blocks locateTop(const LaneGrid& g, const VI* cell) {
  const VI x = hn::ShiftRight<kLogTop>(cell[0]), y = hn::ShiftRight<kLogTop>(cell[1]),
           z = hn::ShiftRight<kLogTop>(cell[2]);
  const VI row = hn::Add(hn::Mul(z, whole(g.top_size[1])), y);
  const VI word = gather(g.top, hn::Add(hn::Mul(row, whole(g.top_size[0])), x));
  const VI kind = hn::And(word, whole(3));
  Blocks b;
  b.far = hn::Eq(kind, whole(0));
  b.node = hn::Eq(kind, whole(3));
  b.radius = hn::Mul(hn::BitCast(f, hn::AndNot(whole(3), word)), real(g.per_metre));
  b.log_side = whole(kLogTop);
  b.leaf = hn::And(hn::ShiftRight<2>(word), whole(0x3FFFFFFF));
  enterSplits(hn::Eq(kind, whole(2)), cell, b);
  return b;
}

/// Below a top cell's node.
inline Blocks locateBelow(const LaneGrid& g, const VI* cell, VI node_index) {
  Blocks b;
  b.far = b.node = none();
  b.radius = real(0.0F);
  b.log_side = whole(kLogTop);
  b.leaf = hn::Zero(n);
  MI split = none(), node = hn::FirstN(n, hn::Lanes(n));
  int shift = kLogTop - 2;
  for (int depth = 0; !hn::AllFalse(n, node); ++depth, shift -= 2) {
    const VI three = whole(3), by = whole(shift);
    const VI child =
        hn::Or(hn::And(hn::Shr(cell[0], by), three), hn::Or(hn::ShiftLeft<2>(hn::And(hn::Shr(cell[1], by), three)),
                                                            hn::ShiftLeft<4>(hn::And(hn::Shr(cell[2], by), three))));
    const VI place = hn::Add(hn::ShiftLeft<6>(node_index), child);
    const VI four = gather(g.codes, hn::ShiftRight<2>(place));
    const VI code = hn::And(hn::Shr(four, hn::ShiftLeft<3>(hn::And(place, three))), whole(255));
    const MI far = hn::And(node, hn::Gt(code, whole(node_code::kFar - 1)));
    const VI magnitude = hn::And(code, whole(31));
    const VI signed_steps = hn::IfThenElse(hn::Eq(hn::And(code, whole(32)), whole(0)), magnitude, hn::Neg(magnitude));
    const VF radius = hn::Mul(hn::ConvertTo(f, signed_steps), real(g.far_step[depth]));
    b.radius = hn::IfThenElse(asReal(far), radius, b.radius);
    b.far = hn::Or(b.far, far);
    b.log_side = hn::IfThenElse(node, by, b.log_side);
    const MI inner = hn::AndNot(far, node);
    if (hn::AllFalse(n, inner)) break;
    // Codes 0 to 63 are leaves, 64 to 127 nodes, 128 to 191 splits; a node's bases are those of leaves, splits, nodes.
    const VI rank = hn::And(code, whole(63));
    const MI is_node = hn::And(inner, hn::Eq(hn::ShiftRight<6>(code), whole(1)));
    const MI is_split = hn::And(inner, hn::Eq(hn::ShiftRight<6>(code), whole(2)));
    const VI which = hn::IfThenElse(is_node, whole(2), hn::IfThenElseZero(is_split, whole(1)));
    const VI safe = hn::IfThenElseZero(inner, node_index);
    const VI base = gather(g.bases, hn::Add(hn::Add(safe, hn::ShiftLeft<1>(safe)), which));
    const VI found = hn::Add(base, rank);
    b.leaf = hn::IfThenElse(inner, found, b.leaf);
    split = hn::Or(split, is_split);
    node = is_node;
    node_index = hn::IfThenElseZero(node, found);
  }
  enterSplits(split, cell, b);
  return b;
}

/// Where each lane leaves a block, and through which face.
struct Exits {
  VI low[3], side;
  VF t;
  MF axis[3];
};

inline Exits exitsOf(const Lanes& lanes, VI log_side) {
  Exits e;
  e.side = hn::Shl(whole(1), log_side);
  const VI mask = hn::Neg(e.side);
  VF t[3];
  for (int k = 0; k < 3; ++k) {
    e.low[k] = hn::And(lanes.cell[k], mask);
    const MF forward = hn::Gt(lanes.d[k], real(0.0F));
    const VI plane = hn::Add(e.low[k], hn::IfThenElseZero(asWhole(forward), e.side));
    const VF way = hn::Sub(hn::ConvertTo(f, plane), lanes.o[k]);
    t[k] = hn::IfThenElse(hn::Eq(lanes.d[k], real(0.0F)), real(1e30F), hn::Div(way, lanes.d[k]));
  }
  const VF nearest = hn::Min(t[0], hn::Min(t[1], t[2]));
  e.axis[0] = hn::Eq(t[0], nearest);
  e.axis[1] = hn::AndNot(e.axis[0], hn::Eq(t[1], nearest));
  e.axis[2] = hn::AndNot(hn::Or(e.axis[0], e.axis[1]), hn::Eq(t[2], nearest));
  e.t = hn::Max(nearest, lanes.t);
  return e;
}

/// Steps lanes to t: through the exit's face, or (`jump`) anywhere. @return lanes that have left the grid.
inline MI advance(const LaneGrid& g, const Exits& e, MF jump, VF t, MI moving, Lanes& lanes) {
  MI outside = none();
  VI next[3];
  for (int k = 0; k < 3; ++k) {
    const VI high = hn::Add(e.low[k], e.side);
    const VI last = whole(g.top_size[k] * AdaptiveShape::kUnits - 1);
    const VI at = hn::ConvertTo(n, hn::Floor(hn::MulAdd(lanes.d[k], t, lanes.o[k])));
    const VI within = hn::Min(hn::Max(at, e.low[k]), hn::Sub(high, whole(1)));
    const MF forward = hn::Gt(lanes.d[k], real(0.0F));
    const VI beyond = hn::IfThenElse(asWhole(forward), high, hn::Sub(e.low[k], whole(1)));
    const VI stepped = hn::IfThenElse(asWhole(e.axis[k]), beyond, within);
    const VI jumped = hn::Min(hn::Max(at, whole(0)), last);
    const VI cell = hn::IfThenElse(asWhole(jump), jumped, stepped);
    outside = hn::Or(outside, hn::Or(hn::Lt(cell, whole(0)), hn::Gt(cell, last)));
    next[k] = cell;
  }
  // Lanes outside stay where they were: all lanes read memory, also those that are done.
  const MI inside = hn::AndNot(outside, moving);
  for (int k = 0; k < 3; ++k) lanes.cell[k] = hn::IfThenElse(inside, next[k], lanes.cell[k]);
  lanes.t = hn::IfThenElse(asReal(moving), t, lanes.t);
  return hn::And(moving, outside);
}

/// A vector's lanes, one by one.
template <class T>
struct Unpacked {
  HWY_ALIGN T value[hn::MaxLanes(f)];
  explicit Unpacked(VF v) { hn::Store(v, f, value); }
  explicit Unpacked(VI v) { hn::Store(v, n, value); }
  T operator[](std::size_t i) const { return value[i]; }
};

template <class Mask, class Visit>
inline void forEach(const Mask& mask, const Visit& visit) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(n, mask, bytes);
  for (std::uint32_t bits = bytes[0] | std::uint32_t(bytes[1]) << 8; bits != 0; bits &= bits - 1) {
    visit(static_cast<std::size_t>(__builtin_ctz(bits)));
  }
}

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
    const VI node_b = hn::IfThenElse(b.live, hn::GatherIndex(n, flight_.leaf.data(), b.index), node_a);
    descendOnce(hn::IfThenElse(a.live, node_a, hn::Zero(n)), a);
    descendOnce(hn::IfThenElse(b.live, node_b, hn::Zero(n)), b);
    const std::size_t few = hn::Lanes(f) / 2;
    int steps = 0;
    while (hn::CountTrue(n, a.live) + hn::CountTrue(n, b.live) > few && ++steps < 4096) {
      descendOnce(hn::IfThenElseZero(a.live, node_a), a);
      descendOnce(hn::IfThenElseZero(b.live, node_b), b);
    }
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

    // The eight corners, in steps.
    const MI split = hn::Gt(leaf, whole(Flight::kSplit - 1));
    const VI plain = hn::ShiftLeft<1>(hn::IfThenZeroElse(split, leaf));
    const bool some_plain = !hn::AllTrue(n, hn::Or(split, hn::Not(used)));
    VI low = some_plain ? gather(g_.leaves, plain) : hn::Zero(n);
    VI high = some_plain ? gather(g_.leaves + 1, plain) : hn::Zero(n);
    if (!hn::AllFalse(n, split)) {
      const VI half = hn::ShiftLeft<1>(hn::IfThenElseZero(split, hn::Sub(leaf, whole(Flight::kSplit))));
      low = hn::IfThenElse(split, gather(g_.splits, half), low);
      high = hn::IfThenElse(split, gather(g_.splits + 1, half), high);
    }
    const VI byte = whole(0x7F);
    const auto step = [&](VI word) { return hn::ConvertTo(f, hn::And(word, byte)); };
    const VF q[8] = {
        step(low),  step(hn::ShiftRight<8>(low)),  step(hn::ShiftRight<16>(low)),  step(hn::ShiftRight<24>(low)),
        step(high), step(hn::ShiftRight<8>(high)), step(hn::ShiftRight<16>(high)), step(hn::ShiftRight<24>(high))};
    const auto topBits = [](VI word) {
      const VI bits =
          hn::And(hn::BitCast(n, hn::ShiftRight<7>(hn::BitCast(hn::RebindToUnsigned<I>(), word))), whole(0x01010101));
      const auto packed = hn::BitCast(hn::RebindToUnsigned<I>(), hn::Mul(bits, whole(0x10204080)));
      return hn::BitCast(n, hn::ShiftRight<28>(packed));
    };
    const VI offset_bits = hn::Or(topBits(low), hn::ShiftLeft<4>(topBits(high)));
    const VF offset = hn::ConvertTo(f, hn::ShiftRight<24>(hn::ShiftLeft<24>(offset_bits)));
    // The isovalue in the corners' steps.
    const VF scale = hn::Div(real(1.0F), gatherReal(g_.corner, log_side));
    const VF shifted = hn::NegMulAdd(offset, gatherReal(g_.offset, log_side), real(g_.sigma));
    const VF iso = hn::MulAdd(shifted, scale, real(63.5F));

    // The cubic (see cellCubic()) of u in [0, 1] from where the lane is to where it leaves.
    const VF per_side = hn::Div(real(1.0F), hn::ConvertTo(f, exits.side));
    VF from[3], way[3];
    for (int k = 0; k < 3; ++k) {
      const VF base = hn::Sub(lanes.o[k], hn::ConvertTo(f, exits.low[k]));
      const auto clamped = [&](VF t) {
        const VF u = hn::Mul(hn::MulAdd(lanes.d[k], t, base), per_side);
        return hn::Min(hn::Max(u, real(0.0F)), real(1.0F));
      };
      from[k] = clamped(lanes.t);
      way[k] = hn::Sub(clamped(t_exit), from[k]);
    }
    const VF xy0 = hn::Mul(from[0], from[1]), xy2 = hn::Mul(way[0], way[1]);
    const VF xy1 = hn::MulAdd(from[0], way[1], hn::Mul(from[1], way[0]));
    struct Quadratic {
      VF c0, c1, c2;
    };
    const auto plane = [&](VF k0, VF kx, VF ky, VF kxy) {
      return Quadratic{hn::MulAdd(kx, from[0], hn::MulAdd(ky, from[1], hn::MulAdd(kxy, xy0, k0))),
                       hn::MulAdd(kx, way[0], hn::MulAdd(ky, way[1], hn::Mul(kxy, xy1))), hn::Mul(kxy, xy2)};
    };
    const VF ax = hn::Sub(q[1], q[0]), ay = hn::Sub(q[2], q[0]), axy = hn::Sub(hn::Sub(q[3], q[2]), ax);
    const Quadratic a = plane(hn::Sub(q[0], iso), ax, ay, axy);
    const VF bz = hn::Sub(q[4], q[0]), bx = hn::Sub(hn::Sub(q[5], q[4]), ax);
    const VF by = hn::Sub(hn::Sub(q[6], q[4]), ay);
    const VF bxy = hn::Sub(hn::Sub(hn::Sub(q[7], q[6]), hn::Sub(q[5], q[4])), axy);
    const Quadratic b = plane(bz, bx, by, bxy);
    const VF c0 = hn::MulAdd(from[2], b.c0, a.c0);
    const VF c1 = hn::MulAdd(from[2], b.c1, hn::MulAdd(way[2], b.c0, a.c1));
    const VF c2 = hn::MulAdd(from[2], b.c2, hn::MulAdd(way[2], b.c1, a.c2));
    const VF c3 = hn::Mul(way[2], b.c2);
    const auto value = [&](VF u) { return hn::MulAdd(u, hn::MulAdd(u, hn::MulAdd(u, c3, c2), c1), c0); };

    const VF zero = real(0.0F), one = real(1.0F);
    const VF at_end = value(one);
    const MF in_start = hn::Le(c0, zero), in_end = hn::Le(at_end, zero);
    const MF crossing = hn::Xor(in_start, in_end);
    // Extrema between: roots of 3 c3 u² + 2 c2 u + c1, by the form that does not cancel.
    const VF c33 = hn::Mul(c3, real(3.0F));
    const VF discriminant = hn::NegMulAdd(c33, c1, hn::Mul(c2, c2));
    const VF s = hn::Neg(hn::Add(c2, hn::CopySign(hn::Sqrt(hn::Max(discriminant, zero)), c2)));
    const VF u1 = hn::Div(s, hn::IfThenElse(hn::Eq(c33, zero), real(1e-30F), c33));
    const VF u2 = hn::Div(c1, hn::IfThenElse(hn::Eq(s, zero), real(1e-30F), s));
    const auto turnsAt = [&](VF u) {
      return hn::And(hn::Ge(discriminant, zero), hn::And(hn::Gt(u, zero), hn::Lt(u, one)));
    };
    const MF turn1 = turnsAt(u1), turn2 = turnsAt(u2);
    // More than one root: an extremum on the other side than both ends, or any two extrema between ends that differ.
    const MF other1 = hn::And(turn1, hn::Xor(hn::Le(value(u1), zero), in_start));
    const MF other2 = hn::And(turn2, hn::Xor(hn::Le(value(u2), zero), in_start));
    const MF several = hn::Or(hn::AndNot(crossing, hn::Or(other1, other2)), hn::And(crossing, hn::And(turn1, turn2)));

    // The root of the others: Newton's steps within a shrinking bracket.
    VF lo = zero, hi = one;
    VF u = hn::Div(c0, hn::Sub(c0, hn::IfThenElse(crossing, at_end, hn::Add(c0, one))));
    VF last = u;
    if (!hn::AllFalse(f, crossing)) {
      for (int i = 0; i < 5; ++i) {
        const VF at = value(u);
        const VF slope = hn::MulAdd(u, hn::MulAdd(u, c33, hn::Add(c2, c2)), c1);
        const MF as_start = hn::Not(hn::Xor(hn::Le(at, zero), in_start));
        lo = hn::IfThenElse(as_start, u, lo);
        hi = hn::IfThenElse(as_start, hi, u);
        const VF newton = hn::Sub(u, hn::Div(at, slope));
        const MF good = hn::And(hn::Ge(newton, lo), hn::Le(newton, hi));
        last = u;
        u = hn::IfThenElse(good, newton, hn::Mul(hn::Add(lo, hi), real(0.5F)));
      }
    }
    const MF loose = hn::And(crossing, hn::Gt(hn::Abs(hn::Sub(u, last)), real(1e-5F)));
    const VF t_root = hn::MulAdd(u, hn::Sub(t_exit, lanes.t), lanes.t);

    const MI hard = hn::And(used, asWhole(hn::Or(several, loose)));
    const MI easy = hn::AndNot(hard, used);
    // A sign that differs from the last block's changes at the face.
    MI over = turn(asWhole(in_start), easy, lanes.t, index, lanes);
    const MI rest = hn::And(hn::AndNot(over, easy), asWhole(crossing));
    over = hn::Or(over, turn(asWhole(in_end), rest, t_root, index, lanes));
    if (!hn::AllFalse(n, hard)) {
      const Unpacked<std::int32_t> ids(index);
      const Unpacked<float> k0(c0), k1(c1), k2(c2), k3(c3), starts(lanes.t), ends(t_exit);
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
    MI done = hn::And(going, asWhole(hn::Ge(exits.t, one)));
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
