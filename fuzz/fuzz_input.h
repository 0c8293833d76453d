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

/// libFuzzer, or replay_main.cpp, calls this with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace sdf_ccd::fuzz {

/// Aborts, which is a finding, if a condition that must hold for every input does not.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

/// Runs an action on untrusted input. It must succeed, or throw a std::exception with a message.
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

/// A file for readers that accept only files; in /dev/shm if it exists. The destructor removes it.
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

/// Takes numbers from an input, for targets that read no file. After the input's end all numbers are zero.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool done() const { return at_ == end_; }
  std::uint8_t byte() { return at_ < end_ ? *at_++ : 0; }
  std::size_t below(std::size_t count) { return byte() % count; }

  /// Mostly numbers of magnitude up to 4, as large ones are refused early; sometimes a double of any bits.
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
