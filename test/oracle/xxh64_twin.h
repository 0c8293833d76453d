#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include <xxhash.h>

#include "sdf_ccd/mesh.h"

/// Pairs of meshes that a hash which is not made against intent takes for one another.
namespace sdf_ccd::test {

/// XXH64 of three counts (vertices, triangles, and the numbers beside them, none), the vertices and the triangles.
inline std::uint64_t xxh64(const TriangleMesh& mesh, std::uint64_t seed) {
  const std::uint64_t counts[] = {mesh.vertices.size(), mesh.triangles.size(), 0};
  std::string bytes(reinterpret_cast<const char*>(counts), sizeof counts);
  bytes.append(reinterpret_cast<const char*>(mesh.vertices.data()), mesh.vertices.size() * sizeof(Vector3d));
  bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()), mesh.triangles.size() * sizeof(Vector3i));
  return XXH64(bytes.data(), bytes.size(), seed);
}

/// A mesh that differs from `mesh` in two coordinates, with an equal xxh64() for seed 1, and for seed 2.
///
/// XXH64 mixes 64-bit words into four lanes by v' = rotl(v + w P₂, 31) P₁. If w changes by d / P₂ without a carry into
/// bit 33 or out of bit 63, v' changes by rotl(d, 31) P₁, whatever v and so the seed is. A change of the lane's next
/// word by −rotl(d, 31) P₁ / P₂ undoes it. Tried are values of d until both coordinates are below 100 m.
inline TriangleMesh xxh64Twin(const TriangleMesh& mesh) {
  constexpr std::uint64_t kP1 = 0x9E3779B185EBCA87ULL, kP2 = 0xC2B2AE3D27D4EB4FULL;
  constexpr std::size_t kLanes = 4;
  std::uint64_t inverse = kP2;  // of P₂ modulo 2⁶⁴: right in 3 bits, and in twice as many after each step of Newton's
  for (int i = 0; i < 5; ++i) inverse *= 2 - kP2 * inverse;
  const auto isSmall = [](double x) { return std::abs(x) < 100.0 && std::abs(x) > 1e-3; };
  const auto plus = [](double number, std::uint64_t difference) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    bits += difference;
    std::memcpy(&number, &bits, sizeof bits);
    return number;
  };
  const std::size_t places = 3 * mesh.vertices.size() - kLanes;
  for (std::uint64_t d = 1; d < std::uint64_t{1} << 33; ++d) {
    TriangleMesh twin;
    const double* const numbers = mesh.vertices[0].data();
    const std::size_t i = d % places;
    const double first = plus(numbers[i], d * inverse);
    const double second = plus(numbers[i + kLanes], 0 - ((d << 31 | d >> 33) * kP1) * inverse);
    if (!isSmall(first) || !isSmall(second)) continue;
    twin = mesh;
    twin.vertices[i / 3][static_cast<int>(i % 3)] = first;
    twin.vertices[(i + kLanes) / 3][static_cast<int>((i + kLanes) % 3)] = second;
    if (xxh64(twin, 1) == xxh64(mesh, 1) && xxh64(twin, 2) == xxh64(mesh, 2)) return twin;
  }
  throw std::logic_error("no twin was found");
}

}  // namespace sdf_ccd::test
