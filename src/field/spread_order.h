#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace sdf_ccd {

/// A permutation of the numbers below `count`: the first few of them, like any few in a row, are spread uniformly.
/// Multiples, modulo `count`, of its golden section, rounded up to the next number that is coprime to `count`.
class SpreadOrder {
 public:
  explicit SpreadOrder(std::size_t count) : count_(count) {
    step_ = static_cast<std::size_t>(std::round(0.6180339887498949 * static_cast<double>(count)));
    while (count > 1 && std::gcd(step_, count) != 1) ++step_;
  }

  std::size_t operator[](std::size_t i) const {
    assert(count_ > 0);
    return i % count_ * step_ % count_;
  }

 private:
  std::size_t count_;
  std::size_t step_;
};

}  // namespace sdf_ccd
