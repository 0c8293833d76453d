#include "ros/queries.h"

#include <limits>

#include "ros/conversions.h"

namespace sdf_ccd {
namespace {

void refuse(const std::string& why, QueryPoints::Response& response) {
  response = {};
  response.message = why;
}

}  // namespace

Queries::Queries(std::shared_ptr<const Scene> scene, const DescribedScene& described,
                 const MonitorParameters& parameters, const TfHistory& history, const TfTracker& tracker)
    : scene_(scene),
      robot_(described.robot),
      tf_prefix_(described.tf_prefix),
      base_joint_(described.base_joint),
      unreachable_(described.unreachable),
      sampling_(parameters.tf.sampling),
      max_points_(parameters.max_points),
      history_(history),
      tracker_(tracker),
      monitor_(scene, parameters.monitor) {}

void Queries::answer(const QueryMotion::Request& request, QueryMotion::Response& response) {
  response.verdict = QueryMotion::Response::NOT_CHECKED;
  try {
    CurrentPoses now = currentPoses(history_, {*robot_, tf_prefix_}, *scene_);
    tracker_.posesAt(ros::Time(), now.X_WB, now.missing);
    const std::string frame = withoutLeadingSlash(request.multi_dof_trajectory.header.frame_id);
    history_.lookup(frame.empty() ? history_.fixedFrame() : frame, ros::Time(), now.X_WM, now.plan_frame_missing);
    const PlannedMotion planned =
        toPlannedMotion(request, {*scene_, *robot_, base_joint_, unreachable_, now, sampling_});
    monitor_.reset();
    CycleRequest wanted;
    wanted.max_points = max_points_;
    CycleResult result = monitor_.run(planned.motion, wanted);
    response.success = true;
    response.message = result.pairs.empty() ? "no pairs: there is nothing to check" : planned.notes;
    addUnchecked(planned.unchecked, result);
    for (const AssumedJoint& joint : planned.assumed) {
      response.assumed_joints.push_back(joint.name);
      response.assumed_positions.push_back(joint.position);
    }
    response.verdict = static_cast<std::uint8_t>(result.verdict);
    response.error_bound = result.error_bound;
    response.pairs = toPairContacts(result, {*scene_, planned.motion, planned.samples, ros::Time()});
    response.checked = result.checked + result.skipped;
    response.not_checked = result.not_checked;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
  }
}

void Queries::answer(const QueryPoints::Request& request, QueryPoints::Response& response) const {
  const std::string frame =
      request.header.frame_id.empty() ? history_.fixedFrame() : withoutLeadingSlash(request.header.frame_id);
  Isometry3d X_WQ;
  response.success = history_.lookup(frame, request.header.stamp, X_WQ, response.message);
  if (!response.success) return;
  std::vector<Isometry3d> X_WB;
  std::vector<std::string> missing;
  tracker_.posesAt(request.header.stamp, X_WB, missing);
  for (std::size_t body = 0; body < missing.size(); ++body) {
    const Body& description = scene_->bodies[body];
    if (!description.failure.empty()) {
      response.message += "not counted: " + description.failure + "\n";
    } else if (!missing[body].empty()) {
      return refuse("body " + description.name + ": " + missing[body], response);
    } else if (!description.parts.empty() && !description.warning.empty()) {
      response.message += "body " + description.name + ": " + description.warning + "\n";
    }
  }
  for (const geometry_msgs::Point& point : request.points) {
    const Vector3d p_Q = toEigen(point);
    if (!p_Q.allFinite()) return refuse("a point is not finite", response);
    const NearestBody nearest = nearestBody(*scene_, X_WB, X_WQ * p_Q);
    const bool none = nearest.body < 0;
    response.distances.push_back(none ? std::numeric_limits<double>::infinity() : nearest.distance);
    response.errors.push_back(nearest.error);
    response.gradients.push_back(toVector3(X_WQ.linear().transpose() * nearest.gradient_W));
    response.bodies.push_back(none ? "" : scene_->bodies[nearest.body].name);
  }
}

}  // namespace sdf_ccd
