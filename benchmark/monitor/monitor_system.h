#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/scene_plan.h"

namespace sdf_ccd::benchmark {

/// A way to check all pairs of a scene, cycle after cycle.
class MonitorSystem {
 public:
  virtual ~MonitorSystem() = default;

  virtual std::string name() const = 0;

  /// Checks a cycle from poses of all bodies to poses of all bodies.
  /// @return how many pairs touch.
  virtual int check(const std::vector<Isometry3d>& X_WB_start, const std::vector<Isometry3d>& X_WB_end) = 0;
};

using MonitorSystems = std::vector<std::unique_ptr<MonitorSystem>>;

/// Other libraries on the study's scenes: each is one file that adds itself here before main().
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
