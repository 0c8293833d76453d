#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

class SweptBodies;

/// What a pair answers while its bodies do not move relative to each other.
struct RestingAnswer {
  Isometry3d X_AB;
  double error;          ///< of the relative position, for which the answer holds [m]
  CycleRequest request;  ///< what was computed
  MonitorOptions options;
  PairResult result;  ///< of a cycle from 0 to 1 s, during which body A rests at the world's origin
};

/// Answers of pairs that do not move relative to each other, so that each is found once, by whichever cycle or query
/// comes first, as long as its two bodies are part of a scene. Safe to use from any thread.
///
/// Pairs that are CLEAR need none: their clearance tells so from then on, at less cost.
class RestingAnswers {
 public:
  using Bodies = std::pair<BodyList::Shared, BodyList::Shared>;  ///< A and B

  /// An answer that holds, and tells what is requested; null if there is none.
  /// @param X_AB   from which the bodies move by no more than kMoved.
  /// @param error  upper bound of the error of that pose and of all positions [m].
  std::shared_ptr<const RestingAnswer> find(const Bodies& bodies, const Isometry3d& X_AB, double error,
                                            const CycleRequest& request, const MonitorOptions& options) const;

  /// Whether the pair rested in this pose when this was last asked, in whichever cycle or query. Bodies that only turn
  /// round need no answer.
  bool haveRested(const Bodies& bodies, const Isometry3d& X_AB);

  void keep(const Bodies& bodies, std::shared_ptr<const RestingAnswer> answer);

  /// A pose within this is the same one [m]: far more than rounding, and far less than what anyone can measure.
  static constexpr double kMoved = 1e-8;

  /// The error for which an answer is found, if this is needed: other poses within kMoved have it, too.
  static double errorFor(double error) { return error + 2.0 * kMoved; }

 private:
  struct Entry {
    std::weak_ptr<const Body> a, b;
    std::optional<Isometry3d> X_AB_rested;
    std::vector<std::shared_ptr<const RestingAnswer>> answers;
  };

  Entry& entryOf(const Bodies& bodies);
  void dropOld();

  mutable std::mutex mutex_;
  std::map<std::pair<const Body*, const Body*>, Entry> entries_;
  std::size_t size_at_drop_ = 64;
};

/// Writes an answer as the result of a cycle.
/// @param bodies  with the motion of both bodies over result.span. @param error  as it is now [m].
void setResting(const RestingAnswer& answer, const SweptBodies& bodies, double error, int max_points,
                PairResult& result);

}  // namespace sdf_ccd
