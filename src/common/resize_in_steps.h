#pragma once

#include <algorithm>
#include <vector>

#include "common/cancel_point.h"

namespace sdf_ccd {

/// Resizes a large vector so that it can be cancelled meanwhile: the first touch of hundreds of megabytes takes longer
/// than a cancellation may.
template <class T>
void resizeInSteps(std::vector<T>& values, std::size_t size) {
  constexpr std::size_t kStep = std::max<std::size_t>(1, (1 << 20) / sizeof(T));
  values.reserve(size);
  const CancelPoint cancel;
  while (values.size() < size) {
    cancel.check();
    values.resize(std::min(size, values.size() + kStep));
  }
}

}  // namespace sdf_ccd
