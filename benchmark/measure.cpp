#include "measure.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace sdf_ccd::benchmark {
namespace {

/// Stores the time per unit of every repetition; prints nothing.
class Collector : public ::benchmark::BenchmarkReporter {
 public:
  explicit Collector(const MeasureOptions& options, std::size_t tasks) : options_(options), seconds_(tasks) {}

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const double time = options_.wall_clock ? run.real_accumulated_time : run.cpu_accumulated_time;
      seconds_.at(std::stoul(run.run_name.function_name)).push_back(time / run.counters.at("units").value);
    }
  }

  std::vector<double>& seconds(std::size_t task) { return seconds_.at(task); }

 private:
  MeasureOptions options_;
  std::vector<std::vector<double>> seconds_;
};

void initializeOnce() {
  static const bool done = [] {
    char name[] = "benchmark", interleave[] = "--benchmark_enable_random_interleaving=true";
    char* arguments[] = {name, interleave, nullptr};
    int count = 2;
    ::benchmark::Initialize(&count, arguments);
    return true;
  }();
  (void)done;
}

}  // namespace

std::vector<Spread> measure(const std::vector<Task>& tasks, const MeasureOptions& options) {
  initializeOnce();
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    auto* benchmark = ::benchmark::RegisterBenchmark(std::to_string(k).c_str(), [&tasks, k](::benchmark::State& state) {
      std::size_t i = 0, units = 0;
      for (auto _ : state) units += tasks[k].work(i++);
      state.counters["units"] = double(units);
    });
    benchmark->Repetitions(options.runs)->MinTime(options.seconds);
    if (options.wall_clock) benchmark->UseRealTime();
  }
  std::optional<tbb::global_control> one_thread;
  if (!options.wall_clock) one_thread.emplace(tbb::global_control::max_allowed_parallelism, 1);
  Collector collector(options, tasks.size());
  ::benchmark::RunSpecifiedBenchmarks(&collector, "all");
  ::benchmark::ClearRegisteredBenchmarks();
  std::vector<Spread> spreads;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    std::vector<double>& seconds = collector.seconds(k);
    if (seconds.empty()) throw std::runtime_error("benchmark: " + tasks[k].system + " did not run");
    std::sort(seconds.begin(), seconds.end());
    spreads.push_back({seconds[seconds.size() / 2], seconds.front(), seconds.back()});
  }
  return spreads;
}

}  // namespace sdf_ccd::benchmark
