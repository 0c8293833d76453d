#pragma once

#include <cmath>
#include <cstddef>

namespace sdf_ccd {

/// Mean and variance of a sample (Welford 1962).
class SampleMean {
 public:
  void add(double value) {
    ++count_;
    const double step = value - mean_;
    mean_ += step / double(count_);
    squares_ += step * (value - mean_);
  }

  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : 0.0; }

  /// Standard error of the mean, relative to it; 1 if unknown.
  double relativeError() const {
    return count_ > 1 && mean_ > 0.0 ? std::sqrt(variance() / double(count_)) / mean_ : 1.0;
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

}  // namespace sdf_ccd
