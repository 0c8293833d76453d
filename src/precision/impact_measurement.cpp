#include "impact_measurement.h"

#include <cmath>

#include "timing.h"

namespace sdf_ccd::precision {
namespace {

/// @param found  time of impact per motion; negative if none was found.
Measurement rowOf(const Label& label, double seconds, const std::vector<ExactImpact>& exact,
                  const std::vector<double>& found) {
  Measurement row{label, "time of impact (length of travel)", "m", seconds};
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (found[i] >= 0.0) errors.push_back(std::abs(found[i] - exact[i].time) * exact[i].travel);
  }
  row.missed = exact.size() - errors.size();
  if (!errors.empty()) row.error = summarize(std::move(errors));
  return row;
}

}  // namespace

std::vector<Measurement> measureImpacts(const std::vector<ImpactSystem>& systems, const std::vector<ExactImpact>& exact,
                                        const std::function<void(double)>& progress) {
  std::vector<std::vector<double>> found(systems.size(), std::vector<double>(exact.size()));
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    tasks.push_back([&, k] {
      for (std::size_t i = 0; i < exact.size(); ++i)
        found[k][i] = systems[k].impact(exact[i].motion.X_FP_start, exact[i].motion.X_FP_end);
    });
  }
  const std::vector<double> seconds = secondsPerQuery(tasks, exact.size(), progress);
  std::vector<Measurement> rows;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    const Measurement row = rowOf(systems[k].label, seconds[k], exact, found[k]);
    if (row.missed < exact.size()) rows.push_back(row);
  }
  return rows;
}

}  // namespace sdf_ccd::precision
