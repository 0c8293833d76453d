#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sdf_ccd {

/// The numbers below `count`, each once, so that the first few of them, and any few in a row, are spread uniformly:
/// steps of the golden section of `count`, or of the nearest number that is coprime with it.
class SpreadOrder {
 public:
  explicit SpreadOrder(std::size_t count) : count_(count) {
    step_ = static_cast<std::size_t>(std::round(0.6180339887498949 * static_cast<double>(count)));
    while (count > 1 && std::gcd(step_, count) != 1) ++step_;
  }

  std::size_t size() const { return count_; }
  std::size_t operator[](std::size_t i) const {
    assert(count_ > 0);
    return i % count_ * step_ % count_;
  }

 private:
  std::size_t count_;
  std::size_t step_;
};

}  // namespace sdf_ccd
