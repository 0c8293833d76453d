#pragma once

#include <array>
#include <csignal>

namespace sdf_ccd::tools {

/// While it lives, Ctrl-C or SIGTERM does not end the program but is remembered, so that what was done can be kept. A
/// second one ends it as ever. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const;

 private:
  std::array<struct sigaction, 2> before_;
};

}  // namespace sdf_ccd::tools
