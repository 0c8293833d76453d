#pragma once

#include <memory>
#include <string>
#include <vector>

#include "monitor/monitor_system.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::benchmark {

/// The monitor of this package as a MonitorSystem; check() returns 1 if any pair touches, else 0.
class SdfCcdMonitor : public MonitorSystem {
 public:
  SdfCcdMonitor(std::string name, const CycleRequest& request, std::shared_ptr<const Scene> scene,
                const MonitorOptions& options, double period)
      : name_(std::move(name)), monitor_(std::move(scene), options), request_(request) {
    motion_.times = {0.0, period};
    motion_.X_WB.assign(monitor_.scene().bodies.size(), std::vector<Isometry3d>(2, Isometry3d::Identity()));
  }

  std::string name() const override { return name_; }

  void take(const std::vector<Isometry3d>& X_WB_start, const std::vector<Isometry3d>& X_WB_end) {
    for (std::size_t b = 0; b < X_WB_start.size(); ++b) {
      motion_.X_WB[b][0] = X_WB_start[b];
      motion_.X_WB[b][1] = X_WB_end[b];
    }
  }
  const CycleResult& run() { return monitor_.run(motion_, request_); }
  void reset() { monitor_.reset(); }

  int check(const std::vector<Isometry3d>& X_WB_start, const std::vector<Isometry3d>& X_WB_end) override {
    take(X_WB_start, X_WB_end);
    return run().verdict == Verdict::kContact;
  }

 private:
  std::string name_;
  Monitor monitor_;
  CycleRequest request_;
  CycleMotion motion_;
};

/// A request for verdicts only: no wrenches, contact points or skipped pairs.
inline CycleRequest verdictsAlone() {
  CycleRequest request;
  request.wrenches = request.skipped_pairs = request.contacts = false;
  return request;
}

}  // namespace sdf_ccd::benchmark
