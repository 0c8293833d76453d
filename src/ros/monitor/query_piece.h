#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "common/cancel_point.h"
#include "common/refuse.h"
#include "ros/monitor/work_turns.h"

namespace sdf_ccd {

/// An answer to a query while it is made.
struct QueryWork {
  double run_time = 0.0;  ///< without waiting [s]
  std::string used_by;    ///< what took most of the time, if the answer is cancelled
};

inline std::chrono::steady_clock::duration durationOf(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

/// One piece of an answer: waits for its turn, and measures its time.
class QueryPiece {
 public:
  /// @param seconds  that the answer may take.
  /// @throws Cancelled if it takes longer; so does the work of the piece.
  QueryPiece(WorkTurns& turns, double seconds, QueryWork& work)
      : turn_(turns), work_(work), start_(Clock::now()), deadline_(start_ + durationOf(seconds - work.run_time)) {
    checkCancelled();
  }
  ~QueryPiece() { work_.run_time += std::chrono::duration<double>(Clock::now() - start_).count(); }
  QueryPiece(const QueryPiece&) = delete;
  QueryPiece& operator=(const QueryPiece&) = delete;

 private:
  using Clock = CancelRequest::Clock;

  WorkTurns::Turn turn_;
  QueryWork& work_;
  Clock::time_point start_;
  CancelScope deadline_;
};

/// @throws std::invalid_argument if a request holds more than a limit.
inline void requireAtMost(std::size_t limit, std::size_t given, const std::string& what) {
  if (given <= limit) return;
  refuse(std::to_string(given) + " " + what + ": at most " + std::to_string(limit) + " are allowed in one request");
}

}  // namespace sdf_ccd
