#pragma once

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Puts together what a result says of all its pairs from what it says of each: verdict, error bound and counts.
class CycleSummary {
 public:
  /// @param result  whose summary is set; its pairs are not read.
  explicit CycleSummary(CycleResult& result);

  void add(const PairResult& pair);

  /// Pairs that are clear without a test. @param error  the largest of theirs.
  void addSkipped(int count, const ErrorBound& error);

  /// Call it last.
  void finish();

 private:
  void take(const ErrorBound& error);

  CycleResult& result_;
  bool any_ = false;
};

/// The same from all of its pairs.
void summarise(CycleResult& result);

/// Lists the pairs as NOT_CHECKED behind those of the scene: what would be CLEAR as a whole is not.
void addUnchecked(const std::vector<UncheckedPair>& pairs, CycleResult& result);

}  // namespace sdf_ccd
