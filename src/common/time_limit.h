#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "common/cancel_point.h"

namespace sdf_ccd {

/// Work that was ended because it took longer than it may.
struct TookTooLong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls work(), on this thread, and ends it at its next check of a CancelPoint after that time.
/// @param seconds  not negative; infinite: no limit [s].
/// @throws TookTooLong with this message, Cancelled if the caller's own request ended the work, and what work() throws.
template <class Work>
auto withinSeconds(double seconds, const std::string& message, const Work& work) {
  using Clock = CancelRequest::Clock;
  constexpr double kForever = 1e8;  // of three years; the clock's own range is not exceeded [s]
  if (!(seconds < kForever)) return work();
  const CancelPoint caller;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  try {
    const CancelScope scope(deadline);
    return work();
  } catch (const Cancelled&) {
    if (caller.requested() || Clock::now() < deadline) throw;
    throw TookTooLong(message);
  }
}

}  // namespace sdf_ccd
