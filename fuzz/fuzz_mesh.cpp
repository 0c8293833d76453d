// Fuzzes a mesh file of the format that the target is built for.
#include "fuzz_input.h"
#include "mesh/reader/parse_mesh.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  fuzz::attempt([&] {
    const TriangleMesh mesh = parseMeshUnconfined(fuzz::toText(data, size), SDF_CCD_FUZZ_FORMAT);
    validate(mesh);
    fuzz::require(!mesh.triangles.empty(), "a mesh has triangles");
  });
  return 0;
}
