// Part of Queries: query_points.
#include <limits>

#include <ros/console.h>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "monitor/nearest_body.h"
#include "motion/valid_pose.h"
#include "ros/messages/conversions.h"
#include "ros/monitor/queries.h"
#include "ros/monitor/query_piece.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kPointsPerPiece = 500;

}  // namespace

void Queries::findDistances(const QueryPoints::Request& request, QueryPoints::Response& response, QueryWork& work) {
  requireAtMost(limits_.points, request.points.size(), "points");
  const std::string frame =
      request.header.frame_id.empty() ? history_.fixedFrame() : withoutLeadingSlash(request.header.frame_id);
  const std::shared_ptr<const CheckedWorld> world = currentWorld(response.scene_version);
  const Scene& scene = world->scene();
  Isometry3d X_WQ;
  std::string problem;
  if (!history_.lookup(frame, request.header.stamp, X_WQ, problem)) refuse(problem);
  std::vector<Isometry3d> X_WB;
  std::vector<std::string> missing;
  posesAt(history_, world->bodies, request.header.stamp, X_WB, missing);
  NearestBodySearch search(world->snapshot->scene, world->snapshot->description, meshes_, request.approximate);
  for (std::size_t body = 0; body < missing.size(); ++body) {
    const Body& description = scene.bodies[body];
    if (description.failure.empty() && !missing[body].empty())
      refuse("body " + description.name + ": " + missing[body]);
    QueryWork preparing;  // what was prepared once is kept
    const QueryPiece piece(turns_, request_time_, preparing);
    const std::string doubt = search.prepare(body);
    if (doubt.empty()) continue;
    const std::string line = "body " + description.name + ": " + doubt;
    if (search.isIgnored(body)) {
      response.message += line + "\n";
    } else if (doubts_.insert(line).second) {
      ROS_WARN("query_points: %s", line.c_str());
    }
  }
  for (std::size_t first = 0; first < request.points.size(); first += kPointsPerPiece) {
    const QueryPiece piece(turns_, limits_.seconds, work);
    const std::size_t end = std::min(first + kPointsPerPiece, request.points.size());
    const CancelPoint cancel;
    for (std::size_t i = first; i < end; ++i) {
      cancel.check();
      const Vector3d p_W = X_WQ * toEigen(request.points[i]);
      if (!p_W.allFinite()) refuse("point " + std::to_string(i) + " is not finite");
      if (!isNearOrigin(p_W)) {
        refuse("point " + std::to_string(i) + " is more than " + numberText(kFarthestPose) + " m from the origin");
      }
      const NearestBody nearest = search.nearest(X_WB, p_W);
      const bool none = nearest.body < 0;
      PointDistance& point = response.points.emplace_back();
      point.distance = none ? std::numeric_limits<double>::infinity() : nearest.distance;
      point.error = nearest.error;
      point.gradient = toVector3(X_WQ.linear().transpose() * nearest.gradient_W);
      if (!none) point.body = scene.bodies[nearest.body].name;
    }
  }
}

}  // namespace sdf_ccd
