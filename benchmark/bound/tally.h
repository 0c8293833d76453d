#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "precision/error_summary.h"
#include "results.h"

namespace sdf_ccd::benchmark {

/// Compares true errors with the reported error bounds.
class BoundTally {
 public:
  /// @param rounding  error of the reference itself [m]; smaller errors are counted as this one.
  explicit BoundTally(double rounding = 0.0) : rounding_(rounding) {}

  void add(double error, double bound) {
    errors_.push_back(error);
    shares_.push_back(std::max(error, rounding_) / bound);
    check(error - rounding_ <= bound);
  }

  /// Counts a query whose result holds or not, without an error to compare.
  void check(bool holds) {
    ++queries_;
    violations_ += !holds;
  }

  BoundTally& operator+=(const BoundTally& other) {
    queries_ += other.queries_;
    violations_ += other.violations_;
    errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
    shares_.insert(shares_.end(), other.shares_.begin(), other.shares_.end());
    return *this;
  }

  long violations() const { return violations_; }
  long queries() const { return queries_; }

  /// Prints rows of results.csv. Errors are in box sides; `median_ratio` is bound / true error, `largest_share` the
  /// largest error / bound.
  void printRows(const std::string& name, double side) const {
    const auto row = [&](const char* metric, double value, const char* unit) {
      print({"bound", name, "sdf_ccd", metric, value, unit, int(queries_)});
    };
    row("violations", double(violations_), "queries");
    row("queries", double(queries_), "queries");
    if (errors_.empty()) return;
    const precision::ErrorSummary share = precision::summarize(shares_), error = precision::summarize(errors_);
    row("median_ratio", 1.0 / share.median, "1");
    row("largest_share", share.max, "1");
    row("error_median", error.median / side, "box side");
    row("error_p99", error.p99 / side, "box side");
    row("error_max", error.max / side, "box side");
  }

 private:
  double rounding_;
  long queries_ = 0, violations_ = 0;
  std::vector<double> errors_, shares_;
};

}  // namespace sdf_ccd::benchmark
