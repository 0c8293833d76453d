#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/shown_text.h"

namespace sdf_ccd::tools {
namespace {

constexpr int kWidth = 40;

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(shownText(std::move(what))),
      on_terminal_(::isatty(STDERR_FILENO)),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && shown_ >= 0) std::clog << "\r\033[K" << std::flush;
}

void ProgressBar::operator()(double share) {
  if (std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
  const int step = on_terminal_ ? 1 : 10;
  const int percent = static_cast<int>(std::floor(100.0 * std::max(0.0, std::min(share, 1.0)))) / step * step;
  if (percent <= shown_) return;
  shown_ = percent;
  if (on_terminal_) {
    const int done = kWidth * percent / 100;
    std::clog << "\r\033[K" << what_ << " [" << std::string(done, '#') << std::string(kWidth - done, ' ') << "] "
              << percent << " %" << std::flush;
  } else {
    std::cerr << what_ << ": " << percent << " %" << std::endl;
  }
}

}  // namespace sdf_ccd::tools
