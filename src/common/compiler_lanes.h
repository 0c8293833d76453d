#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// SIMD vectors by compiler extensions. Functions marked SDF_CCD_LANES are also compiled for processors with wider
// vectors; the version for the processor is chosen when the program is loaded.
// Highway is not used here, as the package must build without it (Ubuntu 20.04 has none): without vectors uniform
// fields take 3.2 times as long to build, and adaptive ones 3.6 times.
// Not under TSan: it also instruments the resolver function, which runs before TSan is initialised, and crashes.

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define SDF_CCD_LANES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SDF_CCD_LANES __attribute__((target_clones("avx2", "default")))
#endif
#else
#define SDF_CCD_LANES
#endif
#define SDF_CCD_INLINE inline __attribute__((always_inline))
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed between inlined functions only

namespace sdf_ccd::lanes {

constexpr int kWidth = 4;
using Doubles = double __attribute__((vector_size(kWidth * sizeof(double))));

using DoublesInMemory __attribute__((vector_size(kWidth * sizeof(double)), aligned(8), may_alias)) = double;

/// In single precision.
constexpr int kFloatWidth = 8;
using Floats = float __attribute__((vector_size(kFloatWidth * sizeof(float))));

using FloatsInMemory __attribute__((vector_size(kFloatWidth * sizeof(float)), aligned(4), may_alias)) = float;
using Ints = std::int32_t __attribute__((vector_size(kFloatWidth * sizeof(std::int32_t))));
using LongInts = std::int64_t __attribute__((vector_size(kWidth * sizeof(std::int64_t))));

// Clang respects the alignment of an alias only after its name.
static_assert(alignof(DoublesInMemory) == 8 && alignof(FloatsInMemory) == 4,
              "numbers in memory are loaded from anywhere");

SDF_CCD_INLINE Floats load(const float* from) {
  return *reinterpret_cast<const FloatsInMemory*>(from);
}

SDF_CCD_INLINE Doubles load(const double* from) {
  return *reinterpret_cast<const DoublesInMemory*>(from);
}

SDF_CCD_INLINE void store(const Floats& values, float* to) {
  *reinterpret_cast<FloatsInMemory*>(to) = values;
}

SDF_CCD_INLINE void store(const Doubles& values, double* to) {
  *reinterpret_cast<DoublesInMemory*>(to) = values;
}

template <class Lanes>
SDF_CCD_INLINE Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

template <class Lanes>
SDF_CCD_INLINE Lanes smaller(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

/// Clears the signs.
SDF_CCD_INLINE Floats absolute(const Floats& v) {
  return reinterpret_cast<Floats>(reinterpret_cast<Ints>(v) & std::numeric_limits<std::int32_t>::max());
}

SDF_CCD_INLINE Doubles absolute(const Doubles& v) {
  return reinterpret_cast<Doubles>(reinterpret_cast<LongInts>(v) & std::numeric_limits<std::int64_t>::max());
}

SDF_CCD_INLINE Doubles squareRoot(const Doubles& v) {
  return Doubles{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}

SDF_CCD_INLINE Floats squareRoot(const Floats& v) {
  return Floats{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3]),
                std::sqrt(v[4]), std::sqrt(v[5]), std::sqrt(v[6]), std::sqrt(v[7])};
}

SDF_CCD_INLINE double leastOf(const Doubles& v) {
  return std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
}

SDF_CCD_INLINE float leastOf(const Floats& v) {
  using Half = float __attribute__((vector_size(kFloatWidth / 2 * sizeof(float))));
  const Half least = smaller(Half{v[0], v[1], v[2], v[3]}, Half{v[4], v[5], v[6], v[7]});
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Bit i: whether the mask, the result of a comparison, is set in lane i.
SDF_CCD_INLINE std::uint32_t bitsOf(const Ints& mask) {
  using Half = std::int32_t __attribute__((vector_size(kFloatWidth / 2 * sizeof(std::int32_t))));
  const Ints bits = mask & Ints{1, 2, 4, 8, 16, 32, 64, 128};
  const Half all = Half{bits[0], bits[1], bits[2], bits[3]} | Half{bits[4], bits[5], bits[6], bits[7]};
  return static_cast<std::uint32_t>(all[0] | all[1] | all[2] | all[3]);
}

}  // namespace sdf_ccd::lanes
