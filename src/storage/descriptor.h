#pragma once

#include <unistd.h>

#include <utility>

namespace sdf_ccd {

/// An open file that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  bool isOpen() const { return number_ >= 0; }
  void close() {
    if (isOpen()) ::close(release());
  }

 private:
  int number_;
};

}  // namespace sdf_ccd
