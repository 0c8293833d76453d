#include <algorithm>
#include <stdexcept>

#include "robot/joint_spline.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxPieces = 100000;

void requireSizes(const std::vector<std::string>& joints, const std::vector<JointWaypoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto require = [&](const char* what, std::size_t size, bool may_be_empty) {
      if (size == joints.size() || (may_be_empty && size == 0)) return;
      throw std::invalid_argument("point " + std::to_string(i) + " of the trajectory has " + std::to_string(size) +
                                  " " + what + " for " + std::to_string(joints.size()) + " joints");
    };
    require("positions", points[i].positions.size(), false);
    require("velocities", points[i].velocities.size(), true);
    require("accelerations", points[i].accelerations.size(), true);
  }
}

JointSplineOrder orderBetween(const JointWaypoint& start, const JointWaypoint& end) {
  if (start.velocities.empty() || end.velocities.empty()) return JointSplineOrder::kLinear;
  const bool has_accelerations = !start.accelerations.empty() && !end.accelerations.empty();
  return has_accelerations ? JointSplineOrder::kQuintic : JointSplineOrder::kCubic;
}

JointSplinePoint splinePointOf(const JointWaypoint& point, std::size_t joint) {
  return {point.positions[joint], point.velocities.empty() ? 0.0 : point.velocities[joint],
          point.accelerations.empty() ? 0.0 : point.accelerations[joint]};
}

}  // namespace

RobotTrajectory splined(const std::vector<std::string>& joints, const std::vector<JointWaypoint>& points,
                        double tolerance) {
  requireSizes(joints, points);
  RobotTrajectory result;
  const auto add = [&](double time, const auto& positionOf) {
    RobotState state;
    for (std::size_t k = 0; k < joints.size(); ++k) state.positions[joints[k]] = positionOf(k);
    result.times.push_back(time);
    result.states.push_back(state);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const JointWaypoint& end = points[i];
    if (i > 0) {
      const JointWaypoint& start = points[i - 1];
      const double duration = end.time - start.time;
      const JointSplineOrder order = orderBetween(start, end);
      std::vector<JointSpline> splines;
      int pieces = 1;
      for (std::size_t k = 0; k < joints.size() && order != JointSplineOrder::kLinear; ++k) {
        splines.emplace_back(order, splinePointOf(start, k), splinePointOf(end, k), duration);
        pieces = std::max(pieces, piecesWithin(splines.back(), duration, tolerance));
      }
      if (result.times.size() + static_cast<std::size_t>(pieces) > kMaxPieces) {
        throw std::invalid_argument("the trajectory's splines need more than " + std::to_string(kMaxPieces) +
                                    " pieces; split the trajectory");
      }
      if (order != JointSplineOrder::kLinear) result.joint_error = tolerance;
      for (int piece = 1; piece < pieces; ++piece) {
        const double time = duration * piece / pieces;
        add(start.time + time, [&](std::size_t k) { return splines[k].position(time); });
      }
    }
    add(end.time, [&](std::size_t k) { return end.positions[k]; });
  }
  return result;
}

}  // namespace sdf_ccd
