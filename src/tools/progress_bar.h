#pragma once

#include <chrono>
#include <string>

namespace sdf_ccd::tools {

/// Shows progress on stderr after the first second: a bar on a terminal, else a line every ten percent. Call it with
/// the fraction done, from 0 to 1, from one thread at a time.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ~ProgressBar();  ///< removes the bar
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void operator()(double share);

 private:
  std::string what_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point start_;
  int shown_ = -1;  ///< percent
};

}  // namespace sdf_ccd::tools
