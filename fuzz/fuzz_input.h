#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>

/// What libFuzzer, or replay_main.cpp, calls with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace sdf_ccd::fuzz {

/// A finding: what must hold whatever the input.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

/// Does something with a hostile input: it is done, or refused with a reason.
template <class Action>
void attempt(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
}

inline std::string toText(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file for what reads none but files, in memory where the computer has such a place. Removed at the end.
class InputFile {
 public:
  explicit InputFile(const std::string& ending)
      : path_((::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp") + std::string("/sdf_ccd_fuzz_") +
              std::to_string(::getpid()) + ending) {}
  ~InputFile() { std::remove(path_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& write(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    return path_;
  }

 private:
  std::string path_;
};

/// Takes numbers from an input, for what is no file. After its end all are zero.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool done() const { return at_ == end_; }
  std::uint8_t byte() { return at_ < end_ ? *at_++ : 0; }
  std::size_t below(std::size_t count) { return byte() % count; }

  /// Mostly small ones, as what is far out is refused soon; any bits now and then.
  double real() {
    const std::uint8_t kind = byte();
    if (kind < 230) return (byte() - 128) / 32.0;
    std::uint8_t bits[sizeof(double)];
    for (std::uint8_t& part : bits) part = byte();
    double value = 0.0;
    std::memcpy(&value, bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

}  // namespace sdf_ccd::fuzz
