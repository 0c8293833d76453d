#pragma once

#include <array>
#include <csignal>
#include <functional>

namespace sdf_ccd::tools {

/// Thrown when the user interrupts the work. Not a std::exception, which would be taken for the failure of one body.
struct Interrupted {};

/// During its lifetime, Ctrl-C or SIGTERM does not end the program but sets a flag, so that finished work can be kept.
/// A second signal ends it as usual. One instance at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const;

  /// Does work that ends soon after a signal. @throws Interrupted then, and what the work throws.
  void during(const std::function<void()>& work) const;

 private:
  std::array<struct sigaction, 2> before_;
};

}  // namespace sdf_ccd::tools
