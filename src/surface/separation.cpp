#include "separation.h"

#include <algorithm>
#include <limits>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "hull_direction.h"
#include "moving_boxes.h"
#include "triangle_pair.h"

namespace sdf_ccd {
namespace {

constexpr double kCut = 0.4;            // of the smallest known gap: pairs with a larger gap are not refined
constexpr std::size_t kManyNear = 192;  // with more near pairs the interval is halved and all boxes are tested again
constexpr int kLongSearch = 64;         // after so many tests of triangles, boxes are tested more closely
constexpr double kManyBends = 0.25;     // of the gap: boxes lose more to the chords than triangles
constexpr int kLessOften = 8;
constexpr int kTestsOfAPlane = 16;      // of triangles: takes about the same time
constexpr int kMaxTestsWhenOpen = 512;  // upper bound of the tests for a crossing once kApart cannot be proved

/// Part of the motion.
struct Times {
  double start, end;

  double length() const { return end - start; }
  double middle() const { return 0.5 * (start + end); }
};

class SeparationQuery {
 public:
  SeparationQuery(const BoxTree& a, const BoxTree& b, const TwoBodyMotion& motion, const SeparationOptions& options,
                  SeparationWitness& witness, SeparationMemory& memory)
      : a_(a),
        b_(b),
        motion_(motion),
        options_(options),
        witness_(witness),
        memory_(memory),
        limit_(options.max_tests) {}

  int tests() const { return tests_; }

  Separation run() {
    memory_.near.clear();
    const Isometry3d X_start = motion_.X_FP(0.0), X_end = motion_.X_FP(1.0);
    const EndPoses poses{X_start, X_end};
    const double size = coordinateSize(a_, b_, poses);
    rounding_ = kTriangleRounding * size;
    crossing_margin_ = options_.margin + 1e-12 * size;
    if (crossedBefore(X_end)) return found_;
    testBoxes({0.0, 1.0}, poses);
    if (crossed_ || open_ || isDone()) return found_;
    found_.state = SeparationState::kApart;
    found_.distance = lowest_;
    witness_.cross_a = witness_.cross_b = -1;
    return found_;
  }

 private:
  using Triangles = SeparationMemory::Triangles;

  bool isDone() const { return crossed_ || tests_ > limit_; }

  double radii(const Triangles& pair) const { return a_.radius(pair.a) + b_.radius(pair.b); }

  // ---- crossing ----

  Corners placed(int b, const Isometry3d& X_AB) const {
    Corners t = b_.triangle(b).corners;
    for (Vector3d& p : t) p = X_AB * p;
    return t;
  }

  /// How far along the segment between the closest points of the two triangles, from A's to B's, the first of the two
  /// rounded triangles ends. If they overlap, this point is on the surface of one of them, inside the other one.
  /// @param distance  length of the segment [m].
  double borderAlong(double distance, const Triangles& pair) const {
    return std::min(a_.radius(pair.a), distance + b_.radius(pair.b));
  }

  static Vector3d unitOf(const Vector3d& v) {
    return v.squaredNorm() > 0.0 ? Vector3d(v.normalized()) : Vector3d(Vector3d::UnitZ());
  }

  bool testCrossing(const Triangles& pair, const Isometry3d& X_AB, double s) {
    ++tests_;
    const Corners &t_a = a_.triangle(pair.a).corners, t_b = placed(pair.b, X_AB);
    std::optional<Vector3d> point = crossingPoint(t_a, t_b, crossing_margin_);
    Vector3d normal = areaNormal(t_a);
    const double round = radii(pair) - crossing_margin_;
    if (!point && round > 0.0 && radii(pair) > 0.0) {
      const ClosestPair closest = closestPoints(t_a, t_b);
      if (closest.distance2 < round * round) {
        normal = closest.on_b - closest.on_a;
        point = closest.on_a + borderAlong(normal.norm(), pair) * unitOf(normal);
      }
    }
    if (!point) return false;
    crossed_ = true;
    found_.state = SeparationState::kCrossing;
    found_.s = s;
    found_.p_A = *point;
    found_.normal_A = unitOf(normal);
    witness_.cross_a = pair.a;
    witness_.cross_b = pair.b;
    return true;
  }

  bool crossedBefore(const Isometry3d& X_end) {
    return witness_.cross_a >= 0 && testCrossing({witness_.cross_a, witness_.cross_b}, X_end, 1.0);
  }

  // ---- boxes ----

  void setInterval(const Times& times, const EndPoses& poses) {
    times_ = times;
    poses_ = poses;
    chord_error_ = motion_.acceleration * times.length() * times.length() / 8.0 + rounding_;
    nearest_ = kInfinity;
    setCut(options_.margin);
    memory_.filter.size = memory_.exact.size = 0;
  }

  void setCut(double cut) {
    cut_ = cut;
    cut_of_boxes_ = cutOfBoxes(cut);
  }

  /// Tests all triangles over an interval.
  void testBoxes(const Times& times, const EndPoses& poses) {
    setInterval(times, poses);
    MovingBoxes boxes(a_, b_, poses, chord_error_);
    if (witness_.near_a < 0) findNear(boxes);
    if (testWitness(boxes)) return;
    const auto testHalves = [&] {
      halve(times, poses, [this](const Times& half, const EndPoses& ends) { testBoxes(half, ends); });
    };
    if (plane_) {
      const PlaneTest found = testPlane(boxes, *plane_);
      if (found == PlaneTest::kApart) return;
      if (found == PlaneTest::kApartAtEnds) return testHalves();
    }
    const std::size_t known = memory_.near.size();
    const int tests_before = tests_;
    memory_.stack.clear();
    memory_.stack.push_back({a_.root(), b_.root(), -std::numeric_limits<float>::infinity()});
    while (!memory_.stack.empty() && !isDone()) {
      cancel_.check();
      const SeparationMemory::Boxes next = memory_.stack.back();
      memory_.stack.pop_back();
      if (next.gap > cut_) {
        lowest_ = std::min(lowest_, double(next.gap));
        continue;
      }
      descend(boxes, next);
      if (is_direction_new_) boxes.setDirection(direction_);
      is_direction_new_ = false;
      if (tests_ > kLongSearch) boxes.measureClosely();
      const bool is_too_long =
          memory_.near.size() - known > kManyNear || (tests_ - tests_before > kLongSearch && bendsMuch());
      const bool needs_plane = tests_ > (is_too_long ? next_plane_ : kLessOften * next_plane_) && !isDone();
      const PlaneTest plane = needs_plane ? findPlane(boxes) : PlaneTest::kNone;
      if (plane == PlaneTest::kNone && !is_too_long) continue;
      memory_.near.resize(known);
      if (plane != PlaneTest::kApart) testHalves();
      return;
    }
    filter();
    testExactly();
    if (memory_.near.size() > known) refine(known, memory_.near.size(), times, poses);
    memory_.near.resize(known);
  }

  /// Tests the pairs near[first] to near[last - 1] again, over each half of the interval.
  void refine(std::size_t first, std::size_t last, const Times& times, const EndPoses& poses) {
    halve(times, poses, [=](const Times& half, const EndPoses& ends) {
      setInterval(half, ends);
      const std::size_t left = memory_.near.size();
      for (std::size_t i = first; i < last && !isDone(); ++i) add(memory_.near[i]);
      filter();
      testExactly();
      if (memory_.near.size() > left) refine(left, memory_.near.size(), half, ends);
      memory_.near.resize(left);
    });
  }

  template <typename Test>
  void halve(const Times& times, const EndPoses& poses, const Test& test) {
    cancel_.check();
    const double middle = times.middle();
    const Isometry3d X_middle = motion_.X_FP(middle);
    // The later half first: surfaces that touch at its end usually touch in the next query too.
    if (!isDone()) test(Times{middle, times.end}, EndPoses{X_middle, poses.X_AB_end});
    if (!isDone()) test(Times{times.start, middle}, EndPoses{poses.X_AB_start, X_middle});
  }

  void descend(MovingBoxes& boxes, const SeparationMemory::Boxes& at) {
    const std::int32_t below_a = a_.node(at.a.node).below[at.a.lane], below_b = b_.node(at.b.node).below[at.b.lane];
    const bool end_a = BoxTree::isTriangle(below_a), end_b = BoxTree::isTriangle(below_b);
    if (end_a && end_b) return add({BoxTree::triangleOf(below_a), BoxTree::triangleOf(below_b)});
    const bool into_a = !end_a && (end_b || a_.node(at.a.node).reach[at.a.lane] >= b_.node(at.b.node).reach[at.b.lane]);
    NearBoxes found;
    const BoxTree::Node& node = into_a ? a_.node(below_a) : b_.node(below_b);
    into_a ? boxes.gapsInA(node, at.b, cut_of_boxes_, found) : boxes.gapsInB(node, at.a, cut_of_boxes_, found);
    lowest_ = std::min(lowest_, double(found.least_other));
    std::size_t least = memory_.stack.size();
    for (std::uint32_t near = found.near; near != 0; near &= near - 1) {
      const auto i = static_cast<std::int32_t>(__builtin_ctz(near));
      const float gap = found.gaps[i];
      if (least < memory_.stack.size() && gap < memory_.stack[least].gap) least = memory_.stack.size();
      memory_.stack.push_back(into_a ? SeparationMemory::Boxes{{below_a, i}, at.b, gap}
                                     : SeparationMemory::Boxes{at.a, {below_b, i}, gap});
    }
    if (least < memory_.stack.size()) std::swap(memory_.stack[least], memory_.stack.back());  // visited next
  }

  /// Finds triangles near each other by descending to the nearest boxes.
  void findNear(MovingBoxes& boxes) {
    memory_.stack.clear();
    memory_.stack.push_back({a_.root(), b_.root(), 0.0F});
    setCut(1e29);  // no box is pruned; descend() leaves the nearest one at the end
    const double lowest = lowest_;
    while (true) {
      const SeparationMemory::Boxes at = memory_.stack.back();
      const std::int32_t below_a = a_.node(at.a.node).below[at.a.lane], below_b = b_.node(at.b.node).below[at.b.lane];
      if (BoxTree::isTriangle(below_a) && BoxTree::isTriangle(below_b)) {
        witness_.near_a = BoxTree::triangleOf(below_a);
        witness_.near_b = BoxTree::triangleOf(below_b);
        break;
      }
      descend(boxes, at);
    }
    lowest_ = lowest;
    setCut(options_.margin);
  }

  /// Chooses the cut distance and the direction to test from the witness's nearest triangles. @return whether a plane
  /// between them proves that the surfaces are farther apart than the margin.
  bool testWitness(MovingBoxes& boxes) {
    const Triangles pair{witness_.near_a, witness_.near_b};
    TrianglePairs& single = memory_.single;
    single.size = 0;
    single.add(a_.corners(pair.a), b_.corners(pair.b));
    closestGaps(poses_, single);
    ++tests_;
    const double gap = single.gap[0] - radii(pair) - chord_error_;
    direction_ = single.axisOf(0);
    is_direction_new_ = false;
    boxes.setDirection(direction_);
    if (!(gap > options_.margin)) return false;
    nearest_ = gap;
    setCut(std::max(options_.margin, kCut * gap));
    double begin = -kInfinity;
    for (const Vector3d* p : a_.corners(pair.a)) begin = std::max(begin, direction_.dot(*p - a_.origin()));
    // The plane may lie anywhere in the gap: either surface may extend into it by half of what the cut distance leaves.
    return isSlabFree(boxes, begin + a_.radius(pair.a), gap, 0.5 * (gap - cut_));
  }

  /// Whether A ends before a slab across the boxes' direction, and B begins behind it.
  /// @param begin  from A's origin [m]. @param slack  how far either may extend into it [m].
  bool isSlabFree(const MovingBoxes& boxes, double begin, double width, double slack) {
    const double reach_a = boxes.supportA(begin + slack);
    if (!(reach_a < kInfinity)) return false;
    const double reach_b = boxes.supportB(-(begin + width - slack));
    if (!(reach_b < kInfinity)) return false;
    const double apart = -reach_b - reach_a;
    if (!(apart > options_.margin)) return false;
    lowest_ = std::min(lowest_, apart);
    return true;
  }

  enum class PlaneTest {
    kApart,        // all along the interval: proved
    kApartAtEnds,  // and between them too, up to the deviation from chords
    kNone,
  };

  PlaneTest testPlane(MovingBoxes& boxes, const Vector3d& n_A) {
    tests_ += kTestsOfAPlane;
    const ExtentsAlong along = extentsAlong(a_, b_, poses_, n_A);
    if (!(along.gap() > options_.margin)) return PlaneTest::kNone;
    const double gap = along.gap() - chord_error_, room = gap - options_.margin;
    if (!(room > 0.5 * (along.gap() - options_.margin))) return PlaneTest::kApartAtEnds;
    boxes.setDirection(n_A);
    const bool is_free = isSlabFree(boxes, along.end_a, gap, 0.45 * room);
    boxes.setDirection(direction_);
    return is_free || isGapFree(n_A) ? PlaneTest::kApart : PlaneTest::kNone;
  }

  /// As isSlabFree(), from all corners in double precision: where gaps are smaller than the rounding of boxes.
  bool isGapFree(const Vector3d& n_A) {
    tests_ += static_cast<int>((a_.size() + b_.size()) / kTestsOfAPlane);
    const double apart = gapAlong(a_, b_, poses_, n_A) - chord_error_;
    if (!(apart > options_.margin)) return false;
    lowest_ = std::min(lowest_, apart);
    return true;
  }

  /// With the direction in which the hulls are farthest apart: where triangles turn on each other, those that are
  /// nearest to each other give no such direction.
  PlaneTest findPlane(MovingBoxes& boxes) {
    plane_ = hullDirection(a_, b_, poses_);
    const PlaneTest found = plane_ ? testPlane(boxes, *plane_) : PlaneTest::kNone;
    next_plane_ = 2 * tests_;
    return found;
  }

  /// Whether chords deviate from the paths by much, compared with what is known of the distance.
  bool bendsMuch() const {
    return chord_error_ > kManyBends * std::max(nearest_ + chord_error_, 0.5 * options_.resolution);
  }

  // ---- triangles ----

  void add(const Triangles& pair) {
    TrianglePairs& group = memory_.filter;
    memory_.filter_ids[group.size] = pair;
    group.add(a_.corners(pair.a), b_.corners(pair.b));
    if (group.size == TrianglePairs::kSize) filter();
  }

  /// Tests by planes first; pairs that they do not separate are tested exactly.
  void filter() {
    TrianglePairs& group = memory_.filter;
    if (group.size == 0) return;
    planeGaps(poses_, direction_, group);
    for (int i = 0; i < group.size && !isDone(); ++i) {
      const Triangles& pair = memory_.filter_ids[i];
      const double gap = group.gap[i] - radii(pair) - chord_error_;
      if (gap > cut_) {
        lowest_ = std::min(lowest_, gap);
        continue;
      }
      memory_.exact_ids[memory_.exact.size] = pair;
      memory_.exact.add(group, i);
      if (memory_.exact.size == TrianglePairs::kSize) testExactly();
    }
    tests_ += group.size;
    group.size = 0;
  }

  void testExactly() {
    TrianglePairs& group = memory_.exact;
    if (group.size == 0) return;
    closestGaps(poses_, group);
    const int size = group.size;
    for (int i = 0; i < size; ++i) {
      const Triangles& pair = memory_.exact_ids[i];
      if (group.gap[i] - radii(pair) - chord_error_ > options_.margin) continue;
      edgeGaps(poses_, group);
      break;
    }
    tests_ += size;
    group.size = 0;
    for (int i = 0; i < size; ++i) {
      const Triangles& pair = memory_.exact_ids[i];
      const double gap = group.gap[i] - radii(pair) - chord_error_;
      if (gap < nearest_) {
        nearest_ = gap;
        witness_.near_a = pair.a;
        witness_.near_b = pair.b;
        setCut(std::max(options_.margin, kCut * gap));
        // After a jump the last query's nearest triangles, and their direction, may be anywhere.
        direction_ = group.axisOf(i);
        is_direction_new_ = true;
      }
      if (gap > options_.margin) {
        lowest_ = std::min(lowest_, gap);
        continue;
      }
      if (testCrossing(pair, poses_.X_AB_end, times_.end)) return;
      if (times_.length() == 1.0 && testCrossing(pair, poses_.X_AB_start, times_.start)) return;
      const double moves = motionOf(pair) + chord_error_;
      if (moves <= std::max(options_.resolution, 2.0 * rounding_)) {
        leaveOpen(moves <= options_.resolution);
      } else {
        memory_.near.push_back(pair);
      }
    }
  }

  /// How far B's triangle moves. If that is less than the resolution, or than rounding can tell, a pair that is not
  /// known to be apart then is left open, and the time is not halved further.
  double motionOf(const Triangles& pair) const {
    double moved = 0.0;
    for (const Vector3d* p : b_.corners(pair.b))
      moved = std::max(moved, (poses_.X_AB_end * *p - poses_.X_AB_start * *p).norm());
    return moved;
  }

  /// kApart can no longer be proved; a crossing still can.
  void leaveOpen(bool is_near) {
    if (is_near) found_.open_within = 2.0 * options_.resolution;
    if (open_) return;
    open_ = true;
    limit_ = std::min(options_.max_tests, tests_ + kMaxTestsWhenOpen);
  }

  const BoxTree &a_, &b_;
  const TwoBodyMotion& motion_;
  const SeparationOptions& options_;
  SeparationWitness& witness_;
  SeparationMemory& memory_;
  double rounding_ = 0.0, crossing_margin_ = 0.0;

  Times times_{0.0, 1.0};  // the interval being tested
  EndPoses poses_;
  double chord_error_ = 0.0;  // upper bound of the deviation of B's points from their chords, and rounding [m]
  Vector3d direction_ = Vector3d::UnitZ();  // of the nearest triangles tested exactly
  bool is_direction_new_ = false;           // and not yet that of the boxes' tests
  double nearest_ = kInfinity;              // gap of the nearest triangles tested exactly
  double cut_ = 0.0;
  float cut_of_boxes_ = 0.0F;      // cutOfBoxes(cut_), which takes a while
  double lowest_ = kInfinity;      // the smallest gap used in a proof
  std::optional<Vector3d> plane_;  // the direction of the last plane between the hulls
  int next_plane_ = kLongSearch;   // the number of tests after which it is looked for
  int tests_ = 0, limit_ = 0;
  bool crossed_ = false, open_ = false;
  CancelTicks<256> cancel_;
  Separation found_;
};

}  // namespace

Separation separation(const BoxTree& a, const BoxTree& b, const TwoBodyMotion& motion, const SeparationOptions& options,
                      SeparationWitness& witness, SeparationMemory& memory) {
  SeparationQuery query(a, b, motion, options, witness, memory);
  Separation found = query.run();
  found.tests = query.tests();
  return found;
}

}  // namespace sdf_ccd
