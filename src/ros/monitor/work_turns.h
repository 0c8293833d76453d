#pragma once

#include <condition_variable>
#include <list>
#include <mutex>
#include <string>

namespace sdf_ccd {

/// Lets a bounded number of callers work in turns, piece by piece: the caller that has waited longest is next. Short
/// work is thus done soon, even beside long work.
class WorkTurns {
 public:
  /// @param max_callers  at a time.
  /// @param what         they are doing, for who is refused: "queries are being answered".
  WorkTurns(int max_callers, std::string what) : max_callers_(max_callers), what_(std::move(what)) {}

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
    /// @throws Cancelled.
    explicit Turn(WorkTurns& turns);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    WorkTurns& turns_;
    std::list<Turn*>::iterator place_;
  };

 private:
  const int max_callers_;
  const std::string what_;
  std::mutex mutex_;
  std::condition_variable first_changed_;
  int callers_ = 0;
  std::list<Turn*> queue_;  // the first one works
};

}  // namespace sdf_ccd
