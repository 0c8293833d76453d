#include "adversarial/ros/tf_truth.h"

#include <algorithm>

namespace sdf_ccd::test {
namespace {

Real seconds(const ros::Time& time) {
  return Real(time.sec) - Real(TfTruth::kEpoch) + Real(time.nsec) * 1e-9L;
}

LongPose poseOf(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  const auto& p = transform.translation;
  return {Eigen::Quaternion<Real>(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(), Vector3l(p.x, p.y, p.z)};
}

}  // namespace

void TfTruth::add(const geometry_msgs::TransformStamped& transform, bool is_static) {
  Edge& edge = edges_[transform.child_frame_id];
  edge.parent = transform.header.frame_id;
  if (is_static) {
    edge.is_static = true;
    edge.rest = poseOf(transform.transform);
    return;
  }
  edge.is_static = false;
  const Real time = seconds(transform.header.stamp);
  const auto next = std::lower_bound(edge.samples.begin(), edge.samples.end(), time,
                                     [](const Sample& sample, Real t) { return sample.time < t; });
  if (next != edge.samples.end() && next->time == time) return;  // the first one with this stamp is kept
  edge.samples.insert(next, {time, poseOf(transform.transform)});
}

void TfTruth::forgetMoving() {
  for (auto& [child, edge] : edges_) edge.samples.clear();
}

LongPose TfTruth::Joint::pose(Real time) const {
  const Real share = length > 0 ? (time - start) / length : 0, angle = share * turn.norm();
  LongPose result = X;
  result.p += share * shift;
  if (angle != 0) result.R = X.R * Eigen::AngleAxis<Real>(angle, turn.normalized()).toRotationMatrix();
  return result;
}

std::vector<const TfTruth::Edge*> TfTruth::edges(const std::string& frame) const {
  std::vector<const Edge*> upwards;
  for (auto edge = edges_.find(frame); edge != edges_.end(); edge = edges_.find(edge->second.parent))
    upwards.push_back(&edge->second);
  return {upwards.rbegin(), upwards.rend()};
}

bool TfTruth::chain(const std::string& frame, Real middle, Chain& joints) const {
  joints.clear();
  for (const Edge* edge : edges(frame)) {
    const auto next = std::lower_bound(edge->samples.begin(), edge->samples.end(), middle,
                                       [](const Sample& sample, Real t) { return sample.time < t; });
    if (next == edge->samples.end()) {
      if (!edge->is_static) return false;
      joints.push_back({0, 0, edge->rest, Vector3l::Zero(), Vector3l::Zero()});
      continue;
    }
    if (next == edge->samples.begin()) return false;
    const Sample &from = *(next - 1), &to = *next;
    joints.push_back(
        {from.time, to.time - from.time, from.X, rotationVector(from.X.R.transpose() * to.X.R), to.X.p - from.X.p});
  }
  return !joints.empty();
}

LongPose TfTruth::pose(const Chain& chain, Real time) {
  LongPose X;
  for (const Joint& joint : chain) X = X * joint.pose(time);
  return X;
}

/// Upper bound of the speed of the body's points [m/s]; each joint moves all that is below it.
Real TfTruth::speed(const Chain& chain, const Pieces& pieces) {
  Real reach = 0, speed = 0;
  for (const Convex& piece : pieces)
    for (const Vector3l& p : piece.corners) reach = std::max(reach, p.norm());
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    if (joint->length > 0) speed += (joint->turn.norm() * reach + joint->shift.norm()) / joint->length;
    reach += std::max(joint->X.p.norm(), (joint->X.p + joint->shift).norm());
  }
  return speed;
}

LeastValue TfTruth::least(const Carried& a, const Carried& b, const ros::Time& from, const ros::Time& to,
                          const LeastOptions& options) const {
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::vector<Real> cuts{seconds(from), seconds(to)};
  for (const Carried* body : {&a, &b})
    for (const Edge* edge : edges(body->frame))
      for (const Sample& sample : edge->samples)
        if (sample.time > cuts[0] && sample.time < cuts[1]) cuts.push_back(sample.time);
  std::sort(cuts.begin(), cuts.end());
  LeastValue all{infinity, infinity, cuts[0]};
  Chain chain_a, chain_b;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!(cuts[i] < cuts[i + 1])) continue;
    const Real middle = (cuts[i] + cuts[i + 1]) / 2;
    if (!chain(a.frame, middle, chain_a) || !chain(b.frame, middle, chain_b)) continue;
    const auto value = [&](Real time) {
      return separation(*a.pieces, pose(chain_a, time), *b.pieces, pose(chain_b, time)).value;
    };
    LeastOptions here = options;
    here.above = std::min(options.above, all.high);  // only values below the smallest one so far matter
    const LeastValue found =
        leastValue(value, cuts[i], cuts[i + 1], speed(chain_a, *a.pieces) + speed(chain_b, *b.pieces), here);
    all.low = std::min(all.low, found.low);
    if (found.high >= all.high) continue;
    all.high = found.high;
    all.at = found.at;
  }
  return all;
}

Separation TfTruth::at(const Carried& a, const Carried& b, Real time) const {
  Chain chain_a, chain_b;
  if (!chain(a.frame, time, chain_a) || !chain(b.frame, time, chain_b)) return {};
  return separation(*a.pieces, pose(chain_a, time), *b.pieces, pose(chain_b, time));
}

}  // namespace sdf_ccd::test
