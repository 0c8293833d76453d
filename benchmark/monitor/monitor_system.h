#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/body.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::benchmark {

/// A system that checks all pairs of a scene, cycle after cycle.
class MonitorSystem {
 public:
  virtual ~MonitorSystem() = default;

  virtual std::string name() const = 0;

  /// Checks a cycle in which all bodies move from their start to their end poses.
  /// @return more than zero if a pair touches; peers return the number of pairs that touch.
  virtual int check(const std::vector<Isometry3d>& X_WB_start, const std::vector<Isometry3d>& X_WB_end) = 0;
};

using MonitorSystems = std::vector<std::unique_ptr<MonitorSystem>>;

/// Factories of systems that check a scene with other libraries. Each is in a file of its own that registers it here
/// before main().
using MonitorPeerFactory =
    std::function<void(const SceneDescription& scene, const std::vector<PlannedPair>& pairs, MonitorSystems& systems)>;

inline std::vector<MonitorPeerFactory>& monitorPeers() {
  static std::vector<MonitorPeerFactory> factories;
  return factories;
}

struct RegisteredMonitorPeer {
  explicit RegisteredMonitorPeer(MonitorPeerFactory factory) { monitorPeers().push_back(std::move(factory)); }
};

}  // namespace sdf_ccd::benchmark
