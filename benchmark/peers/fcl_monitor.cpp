#include <limits>

#include "monitor/fcl_scene.h"
#include "monitor/monitor_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// Collision tests of all pairs at the end of a cycle, as planners do at every pose; the time before is not tested.
class FclMonitor : public MonitorSystem {
 public:
  FclMonitor(const SceneDescription& scene, const std::vector<PlannedPair>& pairs)
      : fcl_(scene.bodies), pairs_(pairs) {}

  std::string name() const override { return "fcl"; }

  int check(const std::vector<Isometry3d>&, const std::vector<Isometry3d>& X_WB_end) override {
    for (std::size_t body = 0; body < X_WB_end.size(); ++body) fcl_.move(static_cast<int>(body), X_WB_end[body]);
    int touching = 0;
    for (const PlannedPair& pair : pairs_) touching += testPair(pair.body_a, pair.body_b);
    return touching;
  }

 protected:
  virtual bool testPair(int a, int b) const { return fcl_.collide(a, b); }

  FclScene fcl_;

 private:
  std::vector<PlannedPair> pairs_;
};

/// The same with distance queries instead of collision tests.
class FclDistanceMonitor : public FclMonitor {
 public:
  using FclMonitor::FclMonitor;

  std::string name() const override { return "fcl_distance"; }

 protected:
  bool testPair(int a, int b) const override { return fcl_.distance(a, b, std::numeric_limits<double>::max()) <= 0.0; }
};

const RegisteredMonitorPeer kFcl{
    [](const SceneDescription& scene, const std::vector<PlannedPair>& pairs, MonitorSystems& systems) {
      systems.push_back(std::make_unique<FclMonitor>(scene, pairs));
      systems.push_back(std::make_unique<FclDistanceMonitor>(scene, pairs));
    }};

}  // namespace
}  // namespace sdf_ccd::benchmark
