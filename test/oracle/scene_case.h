#pragma once

#include <memory>
#include <string>
#include <vector>

#include "oracle/contact_case.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::test {

using Shape = std::variant<Primitive, std::shared_ptr<const TriangleMesh>>;

inline Shape meshShape(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// A body of one part at its origin, in a frame with its own name.
inline BodyDescription body(const std::string& name, const Shape& shape, bool is_world = false) {
  BodyDescription body;
  body.name = name;
  body.frame = is_world ? "world" : name;
  body.is_world = is_world;
  body.geometry.push_back({shape, Isometry3d::Identity(), name + ".stl", false});
  return body;
}

inline BodyOptions fine(double spacing = 0.01) {
  BodyOptions options;
  options.field.cells = 32;
  options.shell.spacing = spacing;
  return options;
}

/// A monitor's options with the stiffness kStiffness.
inline MonitorOptions soft() {
  MonitorOptions options;
  options.contact.stiffness = kStiffness;
  return options;
}

inline std::shared_ptr<const Scene> build(const SceneDescription& description, const BodyOptions& options = fine()) {
  return std::make_shared<const Scene>(buildScene(description, planScene(description), options));
}

inline std::shared_ptr<const Scene> build(std::vector<BodyDescription> bodies, const BodyOptions& options = fine()) {
  return build(SceneDescription{std::move(bodies), {}}, options);
}

/// A motion from poses per body, at times evenly spread over the cycle.
inline CycleMotion cycle(double length, std::vector<std::vector<Isometry3d>> X_WB) {
  CycleMotion motion;
  const std::size_t waypoints = X_WB.front().size();
  for (std::size_t k = 0; k < waypoints; ++k) motion.times.push_back(length * double(k) / double(waypoints - 1));
  motion.X_WB = std::move(X_WB);
  return motion;
}

inline std::vector<Isometry3d> still(const Isometry3d& X, std::size_t waypoints = 2) {
  return {waypoints, X};
}

/// Whether a check at the first or last instant alone would detect the contact.
inline bool touchesAtEnds(const PairResult& pair, double length) {
  const double rounding = 1e-9 * length;
  for (const Interval& interval : pair.intervals)
    if (interval.enter <= rounding || interval.exit >= length - rounding) return true;
  return false;
}

}  // namespace sdf_ccd::test
