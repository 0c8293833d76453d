#pragma once

#include <optional>
#include <vector>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Joins the results of consecutive pieces of a motion, so that a long motion need not be held or checked as a whole.
///
/// Of each pair it keeps the worst verdict, the largest error bound, all intervals (merged where one continues across
/// the end of a piece), the deepest contact, that of each interval, the deepest of the points, and the wrench averaged
/// over the whole motion.
class ResultJoiner {
 public:
  /// @param max_points  upper bound of the contact points listed per pair.
  /// @param margin      CycleRequest::margin of all pieces [m].
  explicit ResultJoiner(int max_points, double margin = 0.0) : max_points_(max_points), margin_(margin) {}

  /// @param motion  the piece; it begins where the last one ended, and every pair was checked over all of it.
  void add(const CycleMotion& motion, const CycleResult& result);

  /// Result of the whole motion: the pairs' spans are {0, 1}, the first and last time of motion(). Valid once a piece
  /// was added.
  CycleResult result() const;

  /// The whole motion, as its first and last poses.
  const CycleMotion& motion() const { return ends_; }

 private:
  /// State of a pair over all pieces.
  struct Known {
    std::optional<double> apart_until;  // start of the first piece that is not CLEAR, or the first touch in it
    double reach = 0.0;                 // upper bound of the depth of points or, where measured, of all [m]
    double near = 0.0;                  // the same of pieces that are UNCERTAIN without a contact
  };

  void addPair(const CycleMotion& motion, const PairResult& piece, PairResult& pair, Known& known) const;
  static void addFirstTouch(double start, const PairResult& piece, PairResult& pair, Known& known);
  static void addLastTouch(double start, double length, const PairResult& piece, PairResult& pair);
  Vector3d shift(int body, const CycleMotion& motion) const;

  int max_points_;
  double margin_;       // [m]
  CycleResult joined_;  // wrenches hold impulses; times are from the start of the motion
  std::vector<Known> known_;
  CycleMotion ends_;
};

}  // namespace sdf_ccd
