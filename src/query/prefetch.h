#pragma once

#include <cstddef>

namespace sdf_ccd {

/// The caches that prefetch() brings memory to, as __builtin_prefetch() numbers them.
enum class CacheLevel { kSecond = 2, kFirst = 3 };

/// Has memory brought to the caches that will be read soon. Of a few lines at a time: while more are under way than the
/// processor can have, all that follows waits. The memory need not exist.
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
