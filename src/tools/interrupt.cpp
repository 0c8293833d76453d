#include "interrupt.h"

#include <atomic>

#include "sdf_ccd/cancel.h"

namespace sdf_ccd::tools {
namespace {

constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};

std::atomic<bool> is_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only set such a flag");

void remember(int) {
  is_requested = true;
}

}  // namespace

Interrupt::Interrupt() {
  is_requested = false;
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &before_[i]);
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interrupt::requested() const {
  return is_requested;
}

void Interrupt::during(const std::function<void()>& work) const {
  const CancelScope scope(is_requested);
  try {
    work();
  } catch (const Cancelled&) {
    throw Interrupted();
  }
}

}  // namespace sdf_ccd::tools
