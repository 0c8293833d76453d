// Runs a fuzz target on files and on all files of folders, for the tests and for compilers without libFuzzer.
// usage: fuzz_TARGET FILE_OR_FOLDER ...

#include <cstdio>
#include <filesystem>
#include <iterator>

#include "fuzz_input.h"

namespace {

namespace fs = std::filesystem;

int replay(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::fprintf(stderr, "%s\n", path.c_str());  // so that the last line names the input of a crash
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  int files = 0;
  for (int i = 1; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) {
      files += replay(argv[i]);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(argv[i])) files += replay(entry.path());
  }
  std::printf("%d inputs\n", files);
  return files > 0 ? 0 : 1;
}
