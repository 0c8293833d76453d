#pragma once

#include <functional>
#include <vector>

#include "oracle/convex.h"
#include "oracle/least_value.h"

/// The smallest separation of two bodies, each moving with a constant twist in the world between poses, or on any path.
namespace sdf_ccd::test {

using LongPath = std::function<LongPose(Real)>;

class PairMotion {
 public:
  /// @param times  of the poses [s], increasing.
  PairMotion(const Pieces& a, const Pieces& b, const std::vector<double>& times, const std::vector<Isometry3d>& X_WA,
             const std::vector<Isometry3d>& X_WB)
      : a_(&a), b_(&b) {
    for (std::size_t k = 0; k + 1 < times.size(); ++k)
      addScrews(times[k], times[k + 1], LongScrew(X_WA[k], X_WA[k + 1]), LongScrew(X_WB[k], X_WB[k + 1]));
  }
  PairMotion(const Pieces& a, const Pieces& b) : a_(&a), b_(&b) {}

  /// Adds a step from one time to another.
  /// @param a, b  the bodies' poses at s, from 0 to 1.
  /// @param rate  upper bound of the sum of their points' speeds, per unit of s [m].
  void add(Real start, Real end, const LongPath& a, const LongPath& b, Real rate) {
    steps_.push_back({start, end, a, b, rate, {}});
  }

  Real begin() const { return steps_.front().start; }
  Real end() const { return steps_.back().end; }
  LongPose poseA(Real time) const { return stepAt(time).a(share(time)); }
  LongPose poseB(Real time) const { return stepAt(time).b(share(time)); }
  Separation at(Real time) const { return separation(*a_, poseA(time), *b_, poseB(time)); }
  Real distanceAt(Real time) const { return surfaceDistance(*a_, poseA(time), *b_, poseB(time)); }

  /// The smallest separation over the whole motion [m], and its time [s].
  LeastValue least(const LeastOptions& options) const {
    LeastValue all{std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity(), 0};
    for (const Step& step : steps_) {
      const auto sample = [&](Real middle, Real half) { return sampleOf(step, middle, half); };
      const LeastValue found = leastOfSamples(sample, 0, 1, options);
      all.low = std::min(all.low, found.low);
      if (found.high >= all.high) continue;
      all.high = found.high;
      all.at = step.start + found.at * (step.end - step.start);
    }
    return all;
  }

 private:
  struct Step {
    Real start, end;
    LongPath a, b;
    Real rate;
    std::vector<LongScrew> screws;  ///< the screws that a and b follow; empty for other paths
  };

  void addScrews(Real start, Real end, const LongScrew& a, const LongScrew& b) {
    add(
        start, end, [a](Real s) { return a.pose(s); }, [b](Real s) { return b.pose(s); },
        fastest(*a_, a) + fastest(*b_, b));
    steps_.back().screws = {a, b};
  }

  /// The separation changes by at most the rate. Along an axis on which two pieces have the gap g (or overlap by −g),
  /// the gap changes at most as fast as the points move along it in the middle, plus the change of their velocities.
  LeastSample sampleOf(const Step& step, Real middle, Real half) const {
    const LongPose X_WA = step.a(middle), X_WB = step.b(middle);
    Real low = std::numeric_limits<Real>::infinity();
    const auto visit = [&](const Convex& a, const Convex& b, const Separation& pair) {
      Real least = pair.value - step.rate * half;
      if (!step.screws.empty() && !a.is_ball && !b.is_ball) {
        const Range along_a = speeds(a, step.screws[0], X_WA, pair.axis_W);
        const Range along_b = speeds(b, step.screws[1], X_WB, pair.axis_W);
        const Real closing = std::max({along_a.high - along_b.low, along_b.high - along_a.low, Real(0)});
        least = std::max(least, pair.value - closing * half - (along_a.turn + along_b.turn) * half * half / 2);
      }
      low = std::min(low, least);
    };
    const Real value = separation(*a_, X_WA, *b_, X_WB, visit).value;
    return {value, low};
  }

  /// The range of a piece's points' speeds along an axis, and `turn`, an upper bound of their change per unit of s.
  struct Range {
    Real low = std::numeric_limits<Real>::infinity(), high = -low, turn = 0;
  };

  static Range speeds(const Convex& piece, const LongScrew& screw, const LongPose& X, const Vector3l& axis_W) {
    const Vector3l axis = X.R.transpose() * axis_W;
    Range range;
    for (const Vector3l& p : piece.corners) {
      const Vector3l velocity = screw.velocity(p);
      range.low = std::min(range.low, axis.dot(velocity));
      range.high = std::max(range.high, axis.dot(velocity));
      range.turn = std::max(range.turn, screw.turningSpeed() * velocity.norm());
    }
    return range;
  }

  /// The speed is a convex function of the point, so it is largest at a corner.
  static Real fastest(const Pieces& pieces, const LongScrew& screw) {
    Real fastest = 0;
    for (const Convex& piece : pieces)
      for (const Vector3l& p : piece.corners) fastest = std::max(fastest, screw.speed(p));
    return fastest;
  }

  const Step& stepAt(Real time) const {
    for (const Step& step : steps_)
      if (time <= step.end) return step;
    return steps_.back();
  }
  Real share(Real time) const {
    const Step& step = stepAt(time);
    return std::min(std::max((time - step.start) / (step.end - step.start), Real(0)), Real(1));
  }

  const Pieces *a_, *b_;
  std::vector<Step> steps_;
};

}  // namespace sdf_ccd::test
