#pragma once

#include <cstdio>
#include <string>

namespace sdf_ccd::benchmark {

/// A row of results.csv: study,case,system,metric,value,unit,runs.
struct Row {
  std::string study, name, system, metric;
  double value;
  std::string unit;
  int runs = 1;
};

inline void print(const Row& row) {
  std::printf("%s,%s,%s,%s,%.6g,%s,%d\n", row.study.c_str(), row.name.c_str(), row.system.c_str(), row.metric.c_str(),
              row.value, row.unit.c_str(), row.runs);
  std::fflush(stdout);
}

}  // namespace sdf_ccd::benchmark
