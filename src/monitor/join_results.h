#pragma once

#include <optional>
#include <vector>

#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Puts together what a monitor found on one piece of a motion after the other, so that long motions need not be held,
/// nor checked, as a whole.
///
/// Of each pair it keeps the worst verdict, the largest error bound, all intervals (those that go on over the end of a
/// piece as one), the deepest contact, the deepest of the points, and the wrench as an average over the whole.
class ResultJoiner {
 public:
  /// @param max_points  listed per pair.
  explicit ResultJoiner(int max_points) : max_points_(max_points) {}

  /// @param motion  the piece, which begins where the last one ended; all pairs were checked over all of it.
  void add(const CycleMotion& motion, const CycleResult& result);

  /// Of the whole: its pairs' spans are {0, 1}, the first and the last time of motion(). Complete once at least one
  /// piece was added.
  CycleResult result() const;

  /// The whole, by its two ends.
  const CycleMotion& motion() const { return ends_; }

 private:
  /// Of a pair, over all pieces.
  struct Known {
    std::optional<double> apart_until;  // start of the first piece that is not CLEAR, or when bodies first touch in it
    double reach = 0.0;                 // no place gets deeper, where refined [m]
  };

  void addPair(const CycleMotion& motion, const PairResult& piece, PairResult& pair, Known& known) const;
  static void addFirstTouch(double start, const PairResult& piece, PairResult& pair, Known& known);
  Vector3d shift(int body, const CycleMotion& motion) const;

  int max_points_;
  CycleResult joined_;  // wrenches are impulses, times from the whole's start
  std::vector<Known> known_;
  CycleMotion ends_;
};

}  // namespace sdf_ccd
