// Fuzzes an SRDF.
#include "fuzz_input.h"
#include "sdf_ccd/robot.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sdf_ccd::fuzz::attempt([&] { sdf_ccd::parseSrdf(sdf_ccd::fuzz::toText(data, size), "fuzz"); });
  return 0;
}
