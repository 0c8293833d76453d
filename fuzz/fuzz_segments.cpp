// Fuzzes a CSV file of segments, as `sdf_ccd query` reads it.
#include "fuzz_input.h"
#include "tools/segment_csv.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static const fuzz::InputFile file(".csv");
  fuzz::attempt([&] {
    for (const Segment& segment : tools::readSegments(file.write(fuzz::toText(data, size)))) {
      fuzz::require(segment.start.allFinite() && segment.end.allFinite(), "segments are finite");
    }
  });
  return 0;
}
