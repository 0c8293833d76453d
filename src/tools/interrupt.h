#pragma once

#include <array>
#include <csignal>

namespace sdf_ccd::tools {

/// During its lifetime, Ctrl-C or SIGTERM does not end the program but sets a flag, so that finished work can be kept.
/// A second signal ends it as usual. One instance at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const;

 private:
  std::array<struct sigaction, 2> before_;
};

}  // namespace sdf_ccd::tools
