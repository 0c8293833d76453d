#pragma once

#include <cmath>
#include <limits>

#include "common/infinity.h"

namespace sdf_ccd {

/// Finds the lowest value of a function of s from values met in increasing order of s.
class Deepest {
 public:
  /// Forgets the last value, so that the next one does not count as its neighbour.
  void startRun() { previous_ = {}; }

  void offer(double s, double value) {
    const Value now{s, value};
    if (value < best_.value) {
      left_ = previous_;
      right_ = {};
      best_ = now;
    } else if (previous_.s == best_.s && !right_.known()) {
      right_ = now;
    }
    previous_ = now;
  }

  /// Offers the minimum of a piece, which refine() does not lower. @return whether it is the lowest so far.
  bool offerMinimum(double s, double value) {
    startRun();
    const bool is_lowest = value < best_.value;
    offer(s, value);
    startRun();
    return is_lowest;
  }

  /// Lowers the best value by parabolas through it and its neighbours.
  template <typename Function>
  void refine(const Function& value_at) {
    for (int i = 0; i < 4 && left_.known() && right_.known(); ++i) {
      const double a = best_.s - left_.s, b = best_.s - right_.s;
      const double fa = best_.value - right_.value, fb = best_.value - left_.value;
      const double denominator = 2.0 * (a * fa - b * fb);
      if (denominator == 0.0) return;
      const double s = best_.s - (a * a * fa - b * b * fb) / denominator;
      if (!(s > left_.s && s < right_.s) || std::abs(s - best_.s) < 1e-6 * (right_.s - left_.s)) return;
      const Value tried{s, value_at(s)};
      const bool lower = tried.value < best_.value;
      (lower ? (s < best_.s ? right_ : left_) : (s < best_.s ? left_ : right_)) = lower ? best_ : tried;
      if (lower) best_ = tried;
    }
  }

  bool found() const { return best_.known(); }
  double s() const { return best_.s; }
  double value() const { return best_.value; }

 private:
  struct Value {
    double s = std::numeric_limits<double>::quiet_NaN();
    double value = kInfinity;
    bool known() const { return !std::isnan(s); }
  };
  Value best_, previous_, left_, right_;
};

}  // namespace sdf_ccd
