#include "ros/monitor/reach_guard.h"

#include <algorithm>

#include "motion/two_body_motion.h"
#include "robot/geometry_extent.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

/// Per joint: the frames of its parent and its child.
std::vector<std::string> framesOf(const CheckedWorld& world, const DescribedScene& described,
                                  std::vector<RobotModel::Slide>& slides) {
  std::vector<std::string> frames;
  for (const UnreachablePair& pair : world.unreachable) {
    for (const RobotModel::Slide& slide : pair.slides) {
      const auto isSame = [&](const RobotModel::Slide& other) { return other.joint == slide.joint; };
      if (std::any_of(slides.begin(), slides.end(), isSame)) continue;
      slides.push_back(slide);
      const urdf::Joint& joint = *described.robot->urdf().getJoint(slide.joint);
      frames.push_back(withoutLeadingSlash(described.tf_prefix + joint.parent_link_name));
      frames.push_back(withoutLeadingSlash(described.tf_prefix + joint.child_link_name));
    }
  }
  return frames;
}

}  // namespace

ReachGuard::ReachGuard(const CheckedWorld& world, const DescribedScene& described)
    : world_(world), robot_(described.robot), chains_({}) {
  std::vector<RobotModel::Slide> slides;
  std::vector<std::string> frames = framesOf(world, described, slides);
  for (const RobotModel::Slide& slide : slides) {
    joints_.push_back({slide, robot_->urdf().getJoint(slide.joint).get(), ""});
  }
  std::vector<int> index(world.bodies.size(), -1);  // in guarded_
  for (const UnreachablePair& pair : world.unreachable) {
    addGuarded(pair, index);
  }
  std::vector<bool> is_checked(world.bodies.size(), false);
  for (const PlannedPair& pair : world.scene().pairs)
    for (const int body : {pair.body_a, pair.body_b}) is_checked[static_cast<std::size_t>(body)] = true;
  for (Guarded& guarded : guarded_) {
    if (is_checked[guarded.body]) continue;
    guarded.frame = static_cast<int>(frames.size());
    frames.push_back(withoutLeadingSlash(world.bodies[guarded.body].frame));
  }
  chains_ = TfChains(frames);
}

void ReachGuard::addGuarded(const UnreachablePair& pair, std::vector<int>& index) {
  const auto guardedOf = [&](int body, const BoundingBall& ball) {
    int& of = index[static_cast<std::size_t>(body)];
    if (of < 0) {
      of = static_cast<int>(guarded_.size());
      guarded_.emplace_back();
      guarded_.back().body = static_cast<std::size_t>(body);
    }
    if (!pair.X_AB) guarded_[static_cast<std::size_t>(of)].ball = ball;
    return static_cast<std::size_t>(of);
  };
  GuardedPair guarded{guardedOf(pair.body_a, pair.ball_a), guardedOf(pair.body_b, pair.ball_b), &pair};
  if (!pair.X_AB) {
    guarded.reach = pair.ball_a.radius + pair.ball_b.radius;
    for (const RobotModel::Slide& slide : pair.slides) {
      const auto joint =
          std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.slide.joint == slide.joint; });
      guarded.joints.push_back(static_cast<std::size_t>(joint - joints_.begin()));
    }
    return apart_.push_back(guarded);
  }
  joined_.push_back(guarded);
  const auto [root_a, X_RA] = groupOf(guarded.a);
  const auto [root_b, X_RB] = groupOf(guarded.b);
  if (root_a == root_b) return;
  guarded_[root_b].joined_to = static_cast<int>(root_a);
  guarded_[root_b].X_AB = X_RA * *pair.X_AB * X_RB.inverse();
}

/// The first body of its rigid group, as known so far, and the body's pose in that one.
std::pair<std::size_t, Isometry3d> ReachGuard::groupOf(std::size_t body) const {
  Isometry3d X = Isometry3d::Identity();
  for (; guarded_[body].joined_to >= 0; body = static_cast<std::size_t>(guarded_[body].joined_to))
    X = guarded_[body].X_AB * X;
  return {body, X};
}

std::vector<UncheckedPair> ReachGuard::check(const TfHistory& history, const TrackedCycle& cycle) {
  std::vector<UncheckedPair> unchecked;
  if (cycle.samples.empty()) return unchecked;
  if (!chains_.frames().empty()) copyMotion(history, cycle);
  for (std::vector<GuardedPair>* pairs : {&apart_, &joined_})
    for (GuardedPair& pair : *pairs) pair.is_reported = false;
  if (!guarded_.empty()) checkPoses(cycle.motion, unchecked);
  if (!joints_.empty()) checkJoints(cycle, unchecked);
  return unchecked;
}

void ReachGuard::report(GuardedPair& pair, const std::string& reason, std::vector<UncheckedPair>& unchecked) {
  if (!pair.is_reported) unchecked.push_back({pair.pair->body_a, pair.pair->body_b, reason});
  pair.is_reported = true;
}

void ReachGuard::checkPoses(const CycleMotion& motion, std::vector<UncheckedPair>& unchecked) {
  findSpans(motion);
  for (std::size_t k = 1; k < motion.times.size(); ++k) {
    place(motion, k);
    for (GuardedPair& pair : apart_) {
      if (!mayMeet(pair)) continue;
      report(pair,
             std::string(kOutOfReach) +
                 " according to the URDF, but close to each other in tf: do the URDF and tf belong to the same robot?",
             unchecked);
    }
    if (areJoined()) continue;
    for (GuardedPair& pair : joined_) {
      const Guarded &a = guarded_[pair.a], &b = guarded_[pair.b];
      if (!a.is_known || !b.is_known || areJoinedAt(relativePose(a.X_WB, b.X_WB), *pair.pair->X_AB)) continue;
      report(pair, std::string(kRigidlyJoined) + " in the URDF, but not in tf: do they belong to the same robot?",
             unchecked);
    }
  }
}

void ReachGuard::checkJoints(const TrackedCycle& cycle, std::vector<UncheckedPair>& unchecked) {
  bool all_hold = true;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_[j].problem = problem(j, cycle);
    all_hold &= joints_[j].problem.empty();
  }
  if (all_hold) return;
  for (GuardedPair& pair : apart_)
    for (const std::size_t joint : pair.joints)
      if (!joints_[joint].problem.empty()) report(pair, joints_[joint].problem, unchecked);
}

/// Finds waypoints at which a body's poses are those of tf: it is held at rest where no pair needs it that is known.
/// Where these are several spans, of frames that come late, the last one is taken.
void ReachGuard::findSpans(const CycleMotion& motion) {
  const std::vector<PlannedPair>& pairs = world_.scene().pairs;
  known_.assign(world_.bodies.size(), {0, motion.spans.empty() ? motion.times.size() - 1 : 0});
  const auto isMissing = [&](int body) {
    return !motion.missing.empty() && !motion.missing[static_cast<std::size_t>(body)].empty();
  };
  for (std::size_t p = 0; p < motion.spans.size(); ++p) {
    const WaypointSpan span = motion.spans[p];
    if (span.empty() || isMissing(pairs[p].body_a) || isMissing(pairs[p].body_b)) continue;
    for (const int body : {pairs[p].body_a, pairs[p].body_b}) {
      WaypointSpan& known = known_[static_cast<std::size_t>(body)];
      const bool meets = !known.empty() && span.first <= known.last && known.first <= span.last;
      if (meets) {
        known = {std::min(known.first, span.first), std::max(known.last, span.last)};
      } else if (known.empty() || span.last > known.last) {
        known = span;
      }
    }
  }
}

/// Sets where all guarded bodies are at a waypoint.
void ReachGuard::place(const CycleMotion& motion, std::size_t waypoint) {
  const double time = motion.times[waypoint];
  for (Guarded& guarded : guarded_) {
    const std::size_t body = guarded.body;
    if (guarded.frame < 0) {
      const WaypointSpan& known = known_[body];
      guarded.is_known = !known.empty() && known.first <= waypoint && waypoint <= known.last &&
                         (motion.missing.empty() || motion.missing[body].empty());
      if (guarded.is_known) guarded.X_WB = motion.pose(body, waypoint);
    } else {
      const auto frame = static_cast<std::size_t>(guarded.frame);
      const Interval& part = known_parts_[frame];
      constexpr double kRounding = 1e-6;  // [s]
      guarded.is_known = window_.problem(frame).empty() &&
                         (spans_[frame].is_static || (part.enter - kRounding <= time && time <= part.exit + kRounding));
      if (guarded.is_known)
        guarded.X_WB =
            window_.pose(frame, std::min(std::max(time, part.enter), part.exit)) * world_.bodies[body].X_frame_B;
    }
    if (guarded.is_known) guarded.p_WBall = guarded.X_WB * guarded.ball.center;
  }
}

/// Whether all bodies, as far as known, are where they are rigidly joined.
bool ReachGuard::areJoined() const {
  return std::all_of(guarded_.begin(), guarded_.end(), [&](const Guarded& b) {
    if (b.joined_to < 0 || !b.is_known) return true;
    const Guarded& a = guarded_[static_cast<std::size_t>(b.joined_to)];
    return a.is_known && areJoinedAt(relativePose(a.X_WB, b.X_WB), b.X_AB);
  });
}

/// Whether two bodies are nearer to each other than the URDF's joints allow.
bool ReachGuard::mayMeet(const GuardedPair& pair) const {
  const Guarded &a = guarded_[pair.a], &b = guarded_[pair.b];
  if (!a.is_known || !b.is_known || (a.p_WBall - b.p_WBall).squaredNorm() > pair.reach * pair.reach) return false;
  // An object may be out of reach though the balls meet, as that of a floor is wide.
  const auto isApart = [&](const Guarded& object, const Guarded& link) {
    return world_.scene().bodies[object.body].is_world &&
           distanceBelow(world_.description().bodies[object.body].geometry, object.X_WB.inverse() * link.p_WBall) >
               link.ball.radius;
  };
  return !isApart(a, b) && !isApart(b, a);
}

/// Copies the motion of the joints and of guarded bodies over the cycle, as far as each is known.
void ReachGuard::copyMotion(const TfHistory& history, const TrackedCycle& cycle) {
  history.spans(chains_, spans_);
  parts_.clear();
  known_parts_.clear();
  for (std::size_t frame = 0; frame < spans_.size(); ++frame) {
    // Of a joint both frames are needed at the times at which its child is known.
    const TfSpan& span = spans_[frame < 2 * joints_.size() ? frame | 1 : frame];
    const auto known = [&](double sample) {
      if (span.is_static || !span.problem.empty()) return span.first;
      return std::min(std::max(cycle.origin + ros::Duration(sample), span.first), span.last);
    };
    parts_.push_back({known(cycle.samples.front()), known(cycle.samples.back())});
    const TimePart& part = parts_.back();
    known_parts_.push_back({secondsBetween(cycle.origin, part.from), secondsBetween(cycle.origin, part.until)});
  }
  history.copy(chains_, parts_, cycle.origin, window_);
}

std::string ReachGuard::problem(std::size_t index, const TrackedCycle& cycle) {
  const Joint& joint = joints_[index];
  const std::size_t parent = 2 * index, child = parent + 1;
  for (const std::size_t frame : {child, parent}) {
    if (window_.problem(frame).empty()) continue;
    return std::string(kOutOfReach) + " because of joint " + joint.slide.joint +
           ", whose position is not known: " + window_.problem(frame);
  }
  const Interval& part = known_parts_[child];
  for (const double sample : cycle.samples) {
    const double known = std::min(std::max(sample, part.enter), part.exit);
    const Isometry3d X_PC = relativePose(window_.pose(parent, known), window_.pose(child, known));
    const std::string beyond = beyondReach(joint.slide, robot_->positionAt(*joint.joint, X_PC));
    if (!beyond.empty() || part.enter == part.exit) return beyond;
  }
  return {};
}

}  // namespace sdf_ccd
