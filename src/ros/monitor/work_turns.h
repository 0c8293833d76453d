#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace sdf_ccd {

/// Lets a bounded number of callers work in turns, piece by piece: the caller that has waited longest is next. Short
/// work is thus done soon, even beside long work.
class WorkTurns {
 public:
  /// @param max_callers  at a time.
  explicit WorkTurns(int max_callers) : max_callers_(max_callers) {}

  /// A caller, for its lifetime.
  class Caller {
   public:
    /// @throws std::runtime_error if there are too many already.
    explicit Caller(WorkTurns& turns);
    ~Caller();
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

   private:
    WorkTurns& turns_;
  };

  /// The turn for one piece of work, for its lifetime. Waits for all pieces that came before.
  class Turn {
   public:
    explicit Turn(WorkTurns& turns);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    WorkTurns& turns_;
  };

 private:
  const int max_callers_;
  std::mutex mutex_;
  std::condition_variable served_changed_;
  int callers_ = 0;
  std::uint64_t next_ticket_ = 0;
  std::uint64_t served_ticket_ = 0;
};

}  // namespace sdf_ccd
