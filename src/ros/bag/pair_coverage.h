#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "ros/tf/tf_tracker.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// For how much of the time of all cycles each pair was checked, and those left out were rightly so.
class PairCoverage {
 public:
  /// @param pairs  the number of the scene's pairs, which come first in the result.
  void add(const TrackedCycle& cycle, const CycleResult& result, std::size_t pairs);

  /// Number of pairs that no cycle checked, and the first of them. None if there was no cycle.
  std::size_t neverChecked() const;
  std::size_t firstNeverChecked() const;

  /// Pairs that were checked, but not for longer than a time [s].
  struct Partly {
    std::size_t pairs = 0;
    std::size_t worst = 0;   ///< the pair that was unchecked for the longest time
    double unchecked = 0.0;  ///< of that pair [s]
  };
  Partly partlyChecked(double tolerated) const;

  /// A pair that was left out, but for a time not rightly so: the result had it as NOT_CHECKED.
  struct Doubtful {
    int body_a = -1, body_b = -1;
    double seconds = 0.0;
  };
  /// Those for longer than a time [s], the longest first.
  std::vector<Doubtful> doubtful(double tolerated) const;
  double total() const { return total_; }  ///< the time of all cycles [s]

 private:
  struct Pair {
    bool was_checked = false;
    double seconds = 0.0;
  };
  std::vector<Pair> pairs_;
  std::map<std::pair<int, int>, double> doubtful_;  // by bodies: for how long [s]
  double total_ = 0.0;                              // [s]
  ros::Time end_;                                   // of the last cycle
};

}  // namespace sdf_ccd
