// Fuzzes the YAML file of a simulation. Numbers of more than two digits are skipped: they only make a run take long.
#include <algorithm>

#include "fuzz_input.h"
#include "sdf_ccd/simulation.h"

namespace {

constexpr std::size_t kMaxDigits = 2;

bool isSmall(const std::string& text) {
  std::size_t digits = 0;
  bool is_fraction = false;
  return std::none_of(text.begin(), text.end(), [&](char c) {
    const bool is_digit = c >= '0' && c <= '9';
    is_fraction = is_digit ? is_fraction : c == '.';
    digits = is_digit && !is_fraction ? digits + 1 : 0;
    return digits > kMaxDigits;
  });
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  const std::string text = fuzz::toText(data, size);
  if (!isSmall(text)) return 0;
  fuzz::attempt([&] { parseSimulation(text, "/nonexistent"); });
  return 0;
}
