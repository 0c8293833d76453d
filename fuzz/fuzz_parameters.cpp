// Fuzzes the monitor's parameters, as check-bag reads them from a YAML file.
#include "common/settings/yaml_settings.h"
#include "fuzz_input.h"
#include "ros/parameters/parameters.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static const fuzz::InputFile file(".yaml");
  fuzz::attempt([&] { parseParameters(loadYaml(file.write(fuzz::toText(data, size))), "~"); });
  return 0;
}
