// Fuzzes an OctoMap file, with a memory limit that keeps runs short.
#include "fuzz_input.h"
#include "mesh/reader/parse_octomap.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  constexpr std::uint64_t kMaxMemory = 16 << 20;
  fuzz::attempt([&] {
    const ReadMesh read = parseOctomapUnconfined(fuzz::toText(data, size), kMaxMemory);
    validate(read.mesh);
    fuzz::require(read.resolution > 0.0, "voxels have a size");
  });
  return 0;
}
