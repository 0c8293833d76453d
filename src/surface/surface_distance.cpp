#include "surface_distance.h"

#include <algorithm>
#include <cmath>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "moving_boxes.h"
#include "triangle_pair.h"

namespace sdf_ccd {
namespace {

constexpr int kManyTests = 1000;  // of pairs of triangles, after which SurfaceDistance::slack is used

class DistanceQuery {
 public:
  /// @param slack  for many tests: more than the bounds of boxes lose by rounding.
  DistanceQuery(const BoxTree& a, const BoxTree& b, const Isometry3d& X_AB, double max_distance, double rounding,
                double slack, SeparationMemory& memory)
      : a_(a),
        b_(b),
        X_AB_(X_AB),
        best_(max_distance),
        slack_(slack),
        boxes_(a, b, {X_AB, X_AB}, rounding),
        memory_(memory) {}

  std::optional<SurfaceDistance> run(SeparationWitness& witness) {
    if (witness.near_a >= 0) test(witness.near_a, witness.near_b, witness);
    memory_.stack.clear();
    memory_.stack.push_back({a_.root(), b_.root(), 0.0F});
    while (!memory_.stack.empty() && best_ > 0.0) {
      cancel_.check();
      const SeparationMemory::Boxes next = memory_.stack.back();
      memory_.stack.pop_back();
      if (next.gap < limit()) descend(next, witness);
    }
    if (isLong()) found_->slack = slack_;
    return found_;
  }

 private:
  /// Until something is found, all that is within the maximum distance is searched.
  bool isLong() const { return found_ && tests_ > kManyTests; }

  /// Boxes that are farther apart are not searched [m].
  double limit() const { return isLong() ? std::max(0.0, best_ - slack_) : best_; }

  void test(int i, int k, SeparationWitness& witness) {
    ++tests_;
    const RoundedTriangle &t_a = a_.triangle(i), &t_b = b_.triangle(k);
    Corners in_a = t_b.corners;
    for (Vector3d& p : in_a) p = X_AB_ * p;
    const ClosestPair closest = closestPoints(t_a.corners, in_a);
    const double length = std::sqrt(closest.distance2);
    const double distance = std::max(0.0, length - t_a.radius - t_b.radius);
    // The closest points of corners and edges of triangles that cross may be far from each other.
    const std::optional<Vector3d> crossing =
        mayCross(t_a.corners, in_a) ? crossingPoint(t_a.corners, in_a, 0.0) : std::optional<Vector3d>();
    if (!crossing && !(distance < best_)) return;
    witness.near_a = i;
    witness.near_b = k;
    if (crossing) {
      best_ = 0.0;
      found_ = SurfaceDistance{0.0, *crossing, *crossing};
      return;
    }
    best_ = distance;
    const Vector3d displacement = closest.on_b - closest.on_a;
    const Vector3d n = length > 0.0 ? Vector3d(displacement / length) : Vector3d(Vector3d::UnitZ());
    boxes_.setDirection(n);  // the direction along which most boxes are farthest apart
    const double from_a = std::min(t_a.radius, length), from_b = std::min(t_b.radius, length - from_a);
    found_ = SurfaceDistance{distance, closest.on_a + from_a * n, closest.on_b - from_b * n};
  }

  /// False only if the plane of one of the triangles separates them.
  static bool mayCross(const Corners& a, const Corners& b) {
    const auto isBeside = [](const Corners& face, const Corners& other) {
      const Vector3d n = areaNormal(face);
      double low = kInfinity, high = -low;
      for (const Vector3d& p : other) {
        const double along = n.dot(p - face[0]);
        low = std::min(low, along);
        high = std::max(high, along);
      }
      return low > 0.0 || high < 0.0;
    };
    return !isBeside(a, b) && !isBeside(b, a);
  }

  void descend(const SeparationMemory::Boxes& at, SeparationWitness& witness) {
    const std::int32_t below_a = a_.node(at.a.node).below[at.a.lane], below_b = b_.node(at.b.node).below[at.b.lane];
    const bool end_a = BoxTree::isTriangle(below_a), end_b = BoxTree::isTriangle(below_b);
    if (end_a && end_b) return test(BoxTree::triangleOf(below_a), BoxTree::triangleOf(below_b), witness);
    const bool into_a = !end_a && (end_b || a_.node(at.a.node).reach[at.a.lane] >= b_.node(at.b.node).reach[at.b.lane]);
    NearBoxes found;
    const BoxTree::Node& node = into_a ? a_.node(below_a) : b_.node(below_b);
    const float cut = cutOfBoxes(std::min(limit(), 1e29));
    into_a ? boxes_.gapsInA(node, at.b, cut, found) : boxes_.gapsInB(node, at.a, cut, found);
    const std::size_t first = memory_.stack.size();
    for (std::uint32_t near = found.near; near != 0; near &= near - 1) {
      const auto i = static_cast<std::int32_t>(__builtin_ctz(near));
      memory_.stack.push_back(into_a ? SeparationMemory::Boxes{{below_a, i}, at.b, found.gaps[i]}
                                     : SeparationMemory::Boxes{at.a, {below_b, i}, found.gaps[i]});
    }
    // The nearest pairs first: then most of the others are pruned.
    std::sort(memory_.stack.begin() + static_cast<std::ptrdiff_t>(first), memory_.stack.end(),
              [](const SeparationMemory::Boxes& x, const SeparationMemory::Boxes& y) { return x.gap > y.gap; });
  }

  const BoxTree &a_, &b_;
  Isometry3d X_AB_;
  double best_, slack_;
  int tests_ = 0;
  MovingBoxes boxes_;
  SeparationMemory& memory_;
  std::optional<SurfaceDistance> found_;
  CancelTicks<1024> cancel_;
};

}  // namespace

std::optional<SurfaceDistance> surfaceDistance(const BoxTree& a, const BoxTree& b, const Isometry3d& X_AB,
                                               double max_distance, SeparationWitness& witness,
                                               SeparationMemory& memory) {
  const double between = (X_AB * b.origin() - a.origin()).norm();
  const double radii = a.ball().radius + b.ball().radius, apart = between - radii;
  const double rounding = triangleRounding(a, b, {X_AB, X_AB});
  const double of_balls = kBoxRounding * (radii + std::abs(apart)) + rounding;
  if (apart > max_distance + of_balls) return std::nullopt;
  const double slack = 4.0 * (kBoxRounding * (radii + between) + rounding);
  return DistanceQuery(a, b, X_AB, max_distance, rounding, slack, memory).run(witness);
}

std::optional<double> slabBetween(const BoxTree& a, const BoxTree& b, const Isometry3d& X_AB,
                                  const SurfaceDistance& nearest) {
  constexpr double kSlack = 0.05;  // of the distance, on either side
  if (!(nearest.distance > 0.0)) return std::nullopt;
  const Vector3d n = (nearest.q_A - nearest.p_A).normalized();
  MovingBoxes boxes(a, b, {X_AB, X_AB}, triangleRounding(a, b, {X_AB, X_AB}));
  boxes.setDirection(n);
  const double begin = n.dot(nearest.p_A - a.origin()), slack = kSlack * nearest.distance;
  const double reach_a = boxes.supportA(begin + slack);
  if (!std::isfinite(reach_a)) return std::nullopt;
  const double reach_b = boxes.supportB(-(begin + nearest.distance - slack));
  if (!std::isfinite(reach_b)) return std::nullopt;
  const double width = -reach_b - reach_a;
  return width > 0.0 ? std::optional<double>(width) : std::nullopt;
}

}  // namespace sdf_ccd
