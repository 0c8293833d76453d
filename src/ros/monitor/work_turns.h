#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace sdf_ccd {

/// Lets a bounded number of callers work one at a time, each piece by piece: who has waited longest goes next. So a
/// short work is done soon, however long the others' are.
class WorkTurns {
 public:
  /// @param most  callers at a time.
  explicit WorkTurns(int most) : most_(most) {}

  /// A caller, as long as it lives.
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

  /// A piece of work. Waits for all that came before.
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
  const int most_;
  std::mutex mutex_;
  std::condition_variable next_;
  int callers_ = 0;
  std::uint64_t tickets_ = 0;  // given out
  std::uint64_t turn_ = 0;     // whose it is
};

}  // namespace sdf_ccd
