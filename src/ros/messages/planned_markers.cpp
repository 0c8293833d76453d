#include "ros/messages/planned_markers.h"

#include <algorithm>

#include <fmt/format.h>

#include "motion/screw_motion.h"
#include "ros/messages/shape_marker.h"
#include "ros/messages/status_text.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kStill = 1e-6;        // poses are equal if their matrices differ by less
constexpr int kPathPoints = 200;       // per link
constexpr std::size_t kKeptPoses = 8;  // per piece

const PairResult* firstToTouch(const CycleResult& result) {
  const PairResult* first = nullptr;
  for (const PairResult& pair : result.pairs) {
    if (pair.intervals.empty()) continue;
    if (!first || pair.intervals.front().enter < first->intervals.front().enter) first = &pair;
  }
  return first;
}

}  // namespace

void PlannedMarkers::add(const CycleMotion& piece) {
  const bool is_first = motion_.times.empty();
  const double start = is_first ? 0.0 : motion_.times.back();
  const std::size_t last = piece.times.size() - 1, count = std::min(kKeptPoses, last);
  motion_.missing = piece.missing;
  motion_.X_WB.resize(piece.X_WB.size());
  for (std::size_t i = is_first ? 0 : 1; i <= count; ++i) {
    const std::size_t k = i * last / count;
    motion_.times.push_back(start + piece.times[k]);
    for (std::size_t body = 0; body < piece.X_WB.size(); ++body) {
      if (k < piece.X_WB[body].size()) motion_.X_WB[body].push_back(piece.X_WB[body][k]);
    }
  }
}

bool PlannedMarkers::moves(std::size_t body) const {
  const std::vector<Isometry3d>& poses = motion_.X_WB[body];
  const bool is_known = motion_.missing.empty() || motion_.missing[body].empty();
  return is_known && poses.size() == motion_.times.size() &&
         std::any_of(poses.begin(), poses.end(),
                     [&](const Isometry3d& X) { return !X.matrix().isApprox(poses.front().matrix(), kStill); });
}

/// Pose of the body at a time of the motion [s].
Isometry3d PlannedMarkers::poseAt(std::size_t body, double time) const {
  const std::vector<double>& times = motion_.times;
  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, time);
  const std::size_t k = static_cast<std::size_t>(next - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return ScrewMotion(motion_.X_WB[body][k - 1], motion_.X_WB[body][k]).pose(std::clamp(share, 0.0, 1.0));
}

/// Location of the pair's first contact: of the known points the one that touches first, carried by the moving body to
/// the time when the pair first touches.
Vector3d PlannedMarkers::contactLocation(const PairResult& pair) const {
  const ContactPoint* first = &pair.deepest;
  for (const ContactPoint& point : pair.points) {
    if (point.enter < first->enter) first = &point;
  }
  const std::size_t body = moves(pair.body_a) ? pair.body_a : pair.body_b;
  if (!moves(body)) return first->p_W;
  return poseAt(body, pair.intervals.front().enter) * poseAt(body, first->time).inverse() * first->p_W;
}

void PlannedMarkers::drawGhost(std::size_t body, const Isometry3d& X_WB, const std_msgs::ColorRGBA& color,
                               MarkerArray& markers) const {
  for (const GeometryDescription& geometry : scene_.bodies[body].geometry) {
    Marker ghost = makeMarker("", "ghosts", static_cast<int>(markers.markers.size()), Marker::CUBE);
    ghost.pose = toPose(X_WB * geometry.X_BG);
    ghost.color = color;
    setShape(geometry, ghost);
    markers.markers.push_back(std::move(ghost));
  }
}

MarkerArray PlannedMarkers::draw(const CycleResult& result, const CycleContext& ends,
                                 const std::string& fixed_frame) const {
  MarkerArray markers;
  markers.markers.push_back(deleteAllMarker(fixed_frame));
  if (motion_.times.size() < 2) return markers;
  RobotBox box;
  box.update(result, ends);
  const double length = motion_.times.back();
  const PairResult* first = firstToTouch(result);
  const double end = first ? first->intervals.front().enter : length;
  for (std::size_t body = 0; body < motion_.X_WB.size(); ++body) {
    const bool touches = first && (first->body_a == static_cast<int>(body) || first->body_b == static_cast<int>(body));
    if (touches && moves(body)) {
      drawGhost(body, poseAt(body, end), verdictColor(first->verdict, 0.6F), markers);
    }
    if (!moves(body)) continue;
    for (int i = 0; i < kGhosts; ++i) {
      const double time = length * i / (kGhosts - 1);
      drawGhost(body, poseAt(body, time), verdictColor(Verdict::kClear, 0.12F), markers);
    }
    Marker path = makeMarker("", "paths", static_cast<int>(body), Marker::LINE_STRIP);
    path.scale.x = box.size() / 400.0;
    path.color = toColor(0.0F, 0.75F, 0.55F, 0.9F);
    for (int i = 0; i <= kPathPoints; ++i) {
      const double time = length * i / kPathPoints;
      path.points.push_back(toPoint(poseAt(body, time) * ends.scene.bodies[body].ball.center));
    }
    markers.markers.push_back(std::move(path));
  }
  if (first) {
    Marker location = makeMarker("", "first_contact", 0, Marker::SPHERE);
    location.pose.position = toPoint(contactLocation(*first));
    location.scale.x = location.scale.y = location.scale.z = box.size() / 40.0;
    location.color = toColor(1.0F, 1.0F, 1.0F, 1.0F);
    Marker text = makeMarker("", "first_contact", 1, Marker::TEXT_VIEW_FACING);
    text.text = fmt::format("planned: first contact after {:.2f} s\n{} - {}", end,
                            ends.scene.bodies[first->body_a].name, ends.scene.bodies[first->body_b].name);
    text.pose.position = toPoint(contactLocation(*first) + Vector3d(0.0, 0.0, box.size() / 10.0));
    text.scale.z = box.size() / 28.0;
    text.color = toColor(1.0F, 1.0F, 1.0F, 1.0F);
    markers.markers.insert(markers.markers.end(), {location, text});
  }
  for (Marker& marker : markers.markers) marker.header.frame_id = fixed_frame;
  return markers;
}

}  // namespace sdf_ccd
