#pragma once

#include <functional>
#include <string>
#include <vector>

#include "results.h"

namespace sdf_ccd::benchmark {

/// A task to time: does its i-th piece of work and returns the number of units (segments, pairs) done.
struct Task {
  std::string system;
  std::function<std::size_t(std::size_t i)> work;
};

struct MeasureOptions {
  int runs = 7;
  double seconds = 0.03;    ///< minimum duration of a run
  bool wall_clock = false;  ///< wall time, on all threads; else CPU time, on one thread
};

/// Seconds per unit of a task, over its runs.
struct Spread {
  double median, min, max;
};

/// Times all tasks with Google Benchmark. The runs of all tasks are interleaved in random order, so that changes of the
/// computer's clock frequency or load affect them alike.
std::vector<Spread> measure(const std::vector<Task>& tasks, const MeasureOptions& options);

/// Prints the median as `metric`, the minimum and maximum as `metric`_min and `metric`_max.
inline void print(Row row, const Spread& spread, double scale) {
  const std::string metric = row.metric;
  const auto one = [&](const char* ending, double value) {
    row.metric = metric + ending;
    row.value = scale * value;
    print(row);
  };
  one("", spread.median);
  one("_min", spread.min);
  one("_max", spread.max);
}

}  // namespace sdf_ccd::benchmark
