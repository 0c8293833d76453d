#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "ros/monitor/monitor_loop.h"
#include "ros/monitor/outputs.h"

namespace sdf_ccd {

/// The parts for a version of the world, ready to be adopted between two cycles.
struct PreparedWorld {
  std::uint64_t version = 0;
  std::unique_ptr<LoopChange> loop;
  std::unique_ptr<Outputs::Change> outputs;
};

/// Hands versions of the world over to the thread of the cycles. Whoever prepares one withdraws the last one first;
/// one at a time.
class WorldHandover {
 public:
  /// @param adopt  switches the cycles to a version; called by their thread.
  explicit WorldHandover(std::function<void(PreparedWorld&)> adopt) : adopt_(std::move(adopt)) {}

  /// Gives the cycles some time to adopt the version that waits, then takes it back, and frees the parts that are no
  /// longer needed. After that nothing is adopted until offer().
  /// @return the version that was taken back, to be offered again if no other one comes of it; null if there was none.
  std::unique_ptr<PreparedWorld> withdraw();

  void offer(std::unique_ptr<PreparedWorld> prepared);

  /// Waits for a cycle to adopt this version or a later one, not for long, and frees the former parts.
  /// @return whether one has.
  bool waitFor(std::uint64_t version);

  /// Adopts a version if one waits. To be called by the thread of the cycles, between two cycles; takes microseconds.
  /// @return whether there was one.
  bool adopt();

 private:
  const std::function<void(PreparedWorld&)> adopt_;
  std::mutex mutex_;  // held only to adopt, and to move pointers
  std::condition_variable adopted_;
  std::unique_ptr<PreparedWorld> waiting_, former_;  // former_: the parts that the last version has replaced
  std::uint64_t adopted_version_ = 1;
};

}  // namespace sdf_ccd
