#include "ros/markers.h"

#include <cstdio>

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr const char* kPoints = "points";
constexpr const char* kNormals = "normals";
constexpr const char* kDepth = "depth";
constexpr const char* kSwept = "swept";
constexpr const char* kText = "text";

std_msgs::ColorRGBA color(float r, float g, float b, float a) {
  std_msgs::ColorRGBA result;
  result.r = r;
  result.g = g;
  result.b = b;
  result.a = a;
  return result;
}

// Red for what a check at the recorded transforms would not have seen, orange for what it would.
std_msgs::ColorRGBA contactColor(bool seen_at_samples) {
  return seen_at_samples ? color(1.0f, 0.6f, 0.0f, 1.0f) : color(1.0f, 0.0f, 0.1f, 1.0f);
}

/// Where the body's point that is at p_W at the time of its deepest contact was at every time of the span.
std::vector<Vector3d> pathOf(int body, const ContactPoint& point, const CycleMotion& motion, const KnotSpan& span) {
  std::size_t next = span.first + 1;
  while (next < span.last && motion.times[next] < point.time) ++next;
  const double length = motion.times[next] - motion.times[next - 1];
  const ScrewMotion screw(motion.X_WB[body][next - 1], motion.X_WB[body][next]);
  const Vector3d p_B = screw.pose((point.time - motion.times[next - 1]) / length).inverse() * point.p_W;
  std::vector<Vector3d> path;
  for (std::size_t k = span.first; k <= span.last; ++k) path.push_back(motion.X_WB[body][k] * p_B);
  return path;
}

void addPath(const std::vector<Vector3d>& path, Marker& lines) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    lines.points.push_back(toPoint(path[i]));
    lines.points.push_back(toPoint(path[i + 1]));
  }
}

}  // namespace

/// Its time is 0, so that rviz draws it with its latest transforms.
Marker MarkerDrawer::marker(const char* name, int id, int type) const {
  Marker marker;
  marker.header.frame_id = fixed_frame_;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

MarkerArray MarkerDrawer::draw(const CycleResult& result, const CycleContext& cycle) {
  MarkerArray markers;
  const ros::Time end = cycle.start + ros::Duration(cycle.motion.times.back());
  for (std::size_t id = 0; id < result.pairs.size(); ++id) {
    const PairResult& pair = result.pairs[id];
    if (pair.intervals.empty()) continue;
    drawPair(static_cast<int>(id), pair, cycle, markers);
    shown_until_[static_cast<int>(id)] = end + ros::Duration(options_.hold);
  }
  for (auto shown = shown_until_.begin(); shown != shown_until_.end();) {
    if (shown->second > end) {
      ++shown;
      continue;
    }
    for (const char* name : {kPoints, kNormals, kDepth, kSwept, kText}) {
      markers.markers.push_back(marker(name, shown->first, Marker::SPHERE));
      markers.markers.back().action = Marker::DELETE;
    }
    shown = shown_until_.erase(shown);
  }
  return markers;
}

MarkerArray MarkerDrawer::clear() {
  shown_until_.clear();
  MarkerArray markers;
  markers.markers.push_back(marker("", 0, Marker::SPHERE));
  markers.markers.back().action = Marker::DELETEALL;
  return markers;
}

void MarkerDrawer::drawPair(int id, const PairResult& pair, const CycleContext& cycle, MarkerArray& markers) {
  Marker points = marker(kPoints, id, Marker::SPHERE_LIST);
  Marker normals = marker(kNormals, id, Marker::LINE_LIST);
  Marker depth = marker(kDepth, id, Marker::ARROW);
  Marker swept = marker(kSwept, id, Marker::LINE_LIST);
  points.scale.x = points.scale.y = points.scale.z = 0.007 * options_.scale;
  normals.scale.x = 0.001 * options_.scale;
  depth.scale.x = 0.006 * options_.scale;
  depth.scale.y = 0.014 * options_.scale;
  swept.scale.x = 0.0015 * options_.scale;
  points.color = contactColor(toPairContact(pair, cycle).in_contact_at_samples);
  normals.color = color(1.0f, 1.0f, 1.0f, 0.9f);
  depth.color = color(1.0f, 0.9f, 0.0f, 1.0f);
  swept.color = color(0.1f, 0.5f, 1.0f, 0.9f);

  for (const ContactPoint& point : pair.points) {
    points.points.push_back(toPoint(point.p_W));
    normals.points.push_back(toPoint(point.p_W));
    normals.points.push_back(toPoint(point.p_W + 0.02 * options_.scale * point.normal_W));
    for (const int body : {pair.body_a, pair.body_b}) {
      if (!cycle.scene.bodies[body].is_world) addPath(pathOf(body, point, cycle.motion, pair.span), swept);
    }
  }
  // From the surface's deepest point out to where it would be free, and far enough to be seen.
  depth.points.push_back(toPoint(pair.deepest.p_W));
  depth.points.push_back(
      toPoint(pair.deepest.p_W - (pair.deepest.depth + 0.05 * options_.scale) * pair.deepest.normal_W));
  if (!points.points.empty()) {
    markers.markers.insert(markers.markers.end(), {points, normals, swept});
  }
  markers.markers.push_back(depth);
  drawText(id, pair, cycle, markers);
}

void MarkerDrawer::drawText(int id, const PairResult& pair, const CycleContext& cycle, MarkerArray& markers) {
  Marker text = marker(kText, id, Marker::TEXT_VIEW_FACING);
  char depth[32];
  std::snprintf(depth, sizeof(depth), "%.1f mm", 1e3 * pair.deepest.depth);
  const bool seen = toPairContact(pair, cycle).in_contact_at_samples;
  text.text = cycle.scene.bodies[pair.body_a].name + " - " + cycle.scene.bodies[pair.body_b].name + "\n" + depth +
              (seen ? "" : ", between samples");
  text.pose.position = toPoint(pair.deepest.p_W + Vector3d(0.0, 0.0, 0.15 * options_.scale));
  text.scale.z = 0.03 * options_.scale;
  text.color = seen ? color(1.0f, 1.0f, 1.0f, 1.0f) : color(1.0f, 0.4f, 0.4f, 1.0f);
  markers.markers.push_back(text);
}

}  // namespace sdf_ccd
