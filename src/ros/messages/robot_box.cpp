#include "ros/messages/robot_box.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {
namespace {

constexpr double kStepsPerOctave = 4.0;
constexpr double kSlack = 0.15;  // of the size: smaller displacements are not followed

}  // namespace

void RobotBox::update(const CycleResult& result, const CycleContext& cycle) {
  const BodyList& bodies = cycle.scene.bodies;
  balls_.resize(bodies.size());
  for (const PairResult& pair : result.pairs) {
    if (pair.span.empty()) continue;
    for (const int body : {pair.body_a, pair.body_b}) {
      const bool is_lost = !cycle.motion.missing.empty() && !cycle.motion.missing[body].empty();
      if (is_lost || cycle.motion.X_WB[body].empty()) continue;
      const Vector3d center_W = cycle.motion.pose(body, pair.span.last) * bodies[body].ball.center;
      if (center_W.allFinite()) balls_[body] = {true, center_W};
    }
  }
  const bool has_links = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !body.is_world; });
  AlignedBox3d box;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (!balls_[body].is_known || (has_links && bodies[body].is_world)) continue;
    const Vector3d reach = Vector3d::Constant(bodies[body].ball.radius);
    box.extend(AlignedBox3d(balls_[body].center_W - reach, balls_[body].center_W + reach));
  }
  if (box.isEmpty() || !(box.diagonal().norm() > 0.0)) return;
  size_ = std::exp2(std::round(kStepsPerOctave * std::log2(box.diagonal().norm())) / kStepsPerOctave);
  const Vector3d top(box.center().x(), box.center().y(), box.max().z());
  if ((top - top_).norm() > kSlack * size_) top_ = top;
}

}  // namespace sdf_ccd
