#pragma once

#include "query/worst_verdict.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Accumulates a cycle's verdict, error bound and counts from its pairs, and lists those that are not clear.
class CycleSummary {
 public:
  /// @param result  receives the summary; its pairs are read as they are added.
  /// @param end  the motion's last waypoint: a pair whose empty span is there is done, not delayed.
  CycleSummary(CycleResult& result, std::size_t end);

  /// @param pair  index in the result, each at most once and in any order.
  void add(int pair);

  /// Adds pairs that are clear without a test. @param error  the largest of their error bounds.
  void addSkipped(int count, const ErrorSources& error);

  /// Adds CycleResult::failed.
  void addFailed();

  /// Must be called last.
  void finish();

 private:
  void include(const ErrorSources& error);

  CycleResult& result_;
  std::size_t end_;
  WorstVerdict worst_;
};

/// Summarises a result from all of its pairs.
void summarise(CycleResult& result);

/// Appends the pairs as NOT_CHECKED; a result that was CLEAR as a whole becomes NOT_CHECKED.
void addUnchecked(const std::vector<UncheckedPair>& pairs, CycleResult& result);

}  // namespace sdf_ccd
