#pragma once

#include <cstddef>

namespace sdf_ccd {

/// The caches that prefetch() brings memory to, as __builtin_prefetch() numbers them.
enum class CacheLevel { kSecond = 2, kFirst = 3 };

/// Loads memory that will be read soon into the caches. Use it for a few lines at a time: with more loads in flight
/// than the processor supports, all following loads wait. The memory need not exist.
template <CacheLevel level = CacheLevel::kFirst, class T>
inline void prefetch([[maybe_unused]] const T* first, [[maybe_unused]] std::size_t count) {
#ifdef __GNUC__
  constexpr std::size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(first);
  for (std::size_t k = 0; k < count * sizeof(T); k += kLine) {
    __builtin_prefetch(bytes + k, 0, static_cast<int>(level));
  }
#endif
}

}  // namespace sdf_ccd
