// Fuzzes what is ours of reading a COLLADA file: assimp is only run in its sandbox.
#include "fuzz_input.h"
#include "mesh/reader/collada_check.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  fuzz::attempt([&] { fuzz::require(checkCollada(fuzz::toText(data, size)) > 0.0, "a unit is positive"); });
  return 0;
}
