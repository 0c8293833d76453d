#pragma once

#include <functional>
#include <string>
#include <vector>

#include "results.h"

namespace sdf_ccd::benchmark {

/// Something to time: does its i-th piece of work and returns how many units (segments, pairs) that was.
struct Task {
  std::string system;
  std::function<std::size_t(std::size_t i)> work;
};

struct MeasureOptions {
  int runs = 7;
  double seconds = 0.03;    ///< at least this long per run
  bool wall_clock = false;  ///< for work on all threads; else one thread and its own time
};

/// Seconds per unit of each task over its runs.
struct Spread {
  double median, min, max;
};

/// Times all tasks through Google Benchmark: the runs of all of them in turn, in random order, so that a change of the
/// machine's clock or load meets them alike.
std::vector<Spread> measure(const std::vector<Task>& tasks, const MeasureOptions& options);

/// Prints the median as `metric`, with the smallest and largest as `metric`_min and `metric`_max.
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
