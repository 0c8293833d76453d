#pragma once

#include <algorithm>
#include <cmath>

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
  return std::min(std::min(std::min(v[0], v[1]), std::min(v[2], v[3])),
                  std::min(std::min(v[4], v[5]), std::min(v[6], v[7])));
}

}  // namespace sdf_ccd::lanes
