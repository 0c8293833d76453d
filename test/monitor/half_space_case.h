#pragma once

#include "oracle/scene_case.h"

namespace sdf_ccd::test {

inline CycleRequest verdictOnly() {
  CycleRequest request;
  request.contacts = request.wrenches = false;
  return request;
}

/// A body above a half-space that its description has at X_BG.
struct Fall {
  Fall(const Shape& shape, const Isometry3d& X_BG, bool ground_first = true) : ground_first(ground_first) {
    BodyDescription plane = body("ground", ground());
    plane.geometry[0].X_BG = X_BG;
    std::vector<BodyDescription> bodies = {plane, body("thing", shape)};
    if (!ground_first) std::swap(bodies[0], bodies[1]);
    BodyOptions options = fine(0.02);
    scene = build(std::move(bodies), options);
    monitor = std::make_unique<Monitor>(scene, soft());
  }

  PairResult run(const std::vector<Isometry3d>& X_WG, const std::vector<Isometry3d>& X_WP,
                 const CycleRequest& request = {}) {
    return monitor->run(ground_first ? cycle(0.1, {X_WG, X_WP}) : cycle(0.1, {X_WP, X_WG}), request).pairs.front();
  }

  bool ground_first;
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<Monitor> monitor;
};

}  // namespace sdf_ccd::test
