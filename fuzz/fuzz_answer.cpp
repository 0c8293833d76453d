// Fuzzes the answer of the process that reads meshes; it arrives in pieces, as through a pipe.
#include <algorithm>
#include <stdexcept>

#include "fuzz_input.h"
#include "mesh/import/take_answer.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  constexpr std::size_t kPiece = 37;
  const auto source = [&](char* to, std::size_t wanted) {
    const std::size_t count = std::min({wanted, size, kPiece});
    if (count == 0) throw std::runtime_error("ended");
    std::memcpy(to, data, count);
    data += count;
    size -= count;
    return count;
  };
  ReadLimits limits;
  limits.memory = std::uint64_t{1} << 29;
  fuzz::attempt([&] { validate(receiveAnswer(source, limits).mesh); });
  return 0;
}
