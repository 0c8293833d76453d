#pragma once

#include <cstddef>
#include <vector>

namespace sdf_ccd {

/// A range of values that somebody else owns.
template <class T>
struct View {
  const T* data = nullptr;
  std::size_t size = 0;

  const T& operator[](std::size_t i) const { return data[i]; }
};

template <class T>
View<T> viewOf(const std::vector<T>& values) {
  return {values.data(), values.size()};
}

}  // namespace sdf_ccd
