#include "timing.h"

#include <algorithm>
#include <cmath>

#include <tbb/global_control.h>

#include "common/processor_time.h"
#include "error_summary.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kRounds = 7;
constexpr double kShortest = 2e-3;  // minimum time of a task in a round [s]

double seconds(const std::function<void()>& task, int times) {
  const double start = threadSeconds();
  for (int i = 0; i < times; ++i) task();
  return threadSeconds() - start;
}

}  // namespace

std::vector<double> secondsPerQuery(const std::vector<std::function<void()>>& tasks, std::size_t queries,
                                    const std::function<void(double)>& progress) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<int> times;  // calls of a task in a round
  for (const std::function<void()>& task : tasks) {
    times.push_back(int(std::clamp(std::ceil(kShortest / seconds(task, 1)), 1.0, 1e4)));
  }
  std::vector<std::vector<double>> found(tasks.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      found[i].push_back(seconds(tasks[i], times[i]) / (double(times[i]) * double(queries)));
    }
    progress(double(round + 1) / kRounds);
  }
  std::vector<double> medians;
  for (std::vector<double>& of_task : found) medians.push_back(quantile(of_task, 0.5));
  return medians;
}

}  // namespace sdf_ccd::precision
