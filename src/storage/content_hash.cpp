#include "storage/content_hash.h"

#include <xxhash.h>

#include <cstdio>

namespace sdf_ccd {
namespace {

std::uint64_t hash64(const TriangleMesh& mesh, const std::vector<double>& numbers, std::uint64_t seed) {
  XXH64_state_t* state = XXH64_createState();
  XXH64_reset(state, seed);
  const std::uint64_t counts[] = {mesh.vertices.size(), mesh.triangles.size(), numbers.size()};
  XXH64_update(state, counts, sizeof counts);
  XXH64_update(state, mesh.vertices.data(), mesh.vertices.size() * sizeof(Vector3d));
  XXH64_update(state, mesh.triangles.data(), mesh.triangles.size() * sizeof(Vector3i));
  XXH64_update(state, numbers.data(), numbers.size() * sizeof(double));
  const std::uint64_t hash = XXH64_digest(state);
  XXH64_freeState(state);
  return hash;
}

}  // namespace

std::string contentHash(const TriangleMesh& mesh, const std::vector<double>& numbers) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(hash64(mesh, numbers, 1)),
                static_cast<unsigned long long>(hash64(mesh, numbers, 2)));
  return digits;
}

}  // namespace sdf_ccd
