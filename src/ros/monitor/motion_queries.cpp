// Part of Queries: query_motion and query_motions.
#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "common/cancel_point.h"
#include "common/counted.h"
#include "common/seconds_since.h"
#include "monitor/pair_times.h"
#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "ros/messages/planned_markers.h"
#include "ros/monitor/current_poses.h"
#include "ros/monitor/queries.h"
#include "ros/monitor/query_piece.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

constexpr double kWaitForForces = 0.5;                // share of a request's time
constexpr std::chrono::milliseconds kPollPeriod(10);  // of the wait
constexpr std::size_t kMotionsPerThread = 16;         // in one piece, so that all threads have work in each

/// The frame of all root poses; empty if no motion names one.
std::string rootFrameOf(const std::vector<RobotMotion>& motions) {
  std::string frame;
  for (const RobotMotion& motion : motions) {
    const std::string& of_motion = motion.multi_dof_joint_trajectory.header.frame_id;
    if (!frame.empty() && !of_motion.empty() && of_motion != frame)
      refuse(fmt::format("the root poses of all motions must be in the same frame, but are in {} and {}", frame,
                         of_motion));
    if (!of_motion.empty()) frame = of_motion;
  }
  return frame;
}

CheckedMotion toCheckedMotion(const MotionVerdict& verdict, const Scene& scene) {
  CheckedMotion message;
  const auto setNames = [&](const auto& pair, auto& named) {
    named.body_a = scene.bodies[pair.body_a].name;
    named.body_b = scene.bodies[pair.body_b].name;
  };
  message.verdict = numberOf(verdict.verdict);
  message.error_bound = verdict.error_bound;
  if (verdict.pair >= 0) setNames(scene.pairs[static_cast<std::size_t>(verdict.pair)], message);
  message.time = ros::Duration(verdict.time);
  for (const MotionPairVerdict& pair : verdict.pairs) {
    CheckedPair& listed = message.pairs.emplace_back();
    setNames(pair, listed);
    listed.verdict = numberOf(pair.verdict);
    listed.time = ros::Duration(pair.time);
  }
  return message;
}

/// Whether a contact has no forces yet, which are being built.
bool awaitsForces(const CycleResult& result, const BodyList& bodies) {
  const auto isAwaited = [&](int body) { return bodies[static_cast<std::size_t>(body)].forces == Forces::kAwaited; };
  return std::any_of(result.pairs.begin(), result.pairs.end(), [&](const PairResult& pair) {
    return pair.on_a_W.force.hasNaN() && (isAwaited(pair.body_a) || isAwaited(pair.body_b));
  });
}

/// Does a piece of the work; if it is cancelled, tells what it was at.
template <class Do>
void doPiece(const Do& piece, const PairTimes& times, const Scene& scene, QueryWork& work) {
  try {
    piece();
  } catch (const Cancelled&) {
    work.used_by = times.longest(scene);
    throw;
  }
}

/// Notes on several motions: each text once, with the first motion that it is about. Threads may add at once.
class MotionNotes {
 public:
  void add(std::size_t motion, const std::string& note) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [known, is_new] = first_.emplace(note, motion);
    if (!is_new) known->second = std::min(known->second, motion);
  }

  std::string text() const {
    std::vector<std::string> lines;
    for (const auto& [note, motion] : first_) lines.push_back("motion " + std::to_string(motion) + ": " + note);
    return firstOf(lines, 5, "; ", "; and ");
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::size_t> first_;
};

}  // namespace

/// The world, and the present poses of everything that motions do not specify.
/// @param root_frame  of the motions' root poses.
PlannedScene Queries::planned(const CheckedWorld& world, const std::string& root_frame,
                              bool allow_beyond_limits) const {
  const CurrentPoses now = currentPoses(history_, {*robot_, tf_prefix_}, world);
  PlannedScene scene{world.scene(), *robot_, base_joint_, now, {allow_beyond_limits}};
  const std::string frame = root_frame.empty() ? history_.fixedFrame() : withoutLeadingSlash(root_frame);
  history_.lookup(frame, ros::Time(), scene.X_WM, scene.plan_frame_missing);
  if (ros::Time::isValid()) scene.note = oldTransformsNote(now, ros::Time::now(), max_age_);
  return scene;
}

void Queries::checkMotion(const QueryMotion::Request& request, QueryMotion::Response& response, QueryWork& work) {
  requireAtMost(limits_.waypoints, pointsOf(request.motion), "waypoints");
  const auto start = std::chrono::steady_clock::now();
  const auto mayWait = [&] { return secondsSince(start) <= kWaitForForces * request_time_; };
  while (!checkOnce(request, response, work)) {
    if (!mayWait()) {
      response.message +=
          (response.message.empty() ? "" : "; ") + std::string("forces of some contacts are not known yet");
      return;
    }
    const std::uint64_t version = response.scene_version;
    while (world()->version() == version && mayWait()) {
      checkCancelled();
      std::this_thread::sleep_for(kPollPeriod);
    }
    response = {};
  }
}

/// @return false if forces of a contact are awaited.
bool Queries::checkOnce(const QueryMotion::Request& request, QueryMotion::Response& response, QueryWork& work) {
  std::shared_ptr<const CheckedWorld> world;
  PlannedMotion motion;
  {
    const QueryPiece piece(turns_, limits_.seconds, work);
    world = currentWorld(response.scene_version);  // only now, as this may have waited
    const std::string& frame = request.motion.multi_dof_joint_trajectory.header.frame_id;
    motion = toPlannedMotion(request.motion, planned(*world, frame, static_cast<bool>(request.allow_beyond_limits)),
                             sampling_);
  }
  CycleRequest wanted;
  wanted.max_points = max_points_;
  wanted.margin = request.margin;
  PairTimes times(world->scene().pairs.size());
  wanted.times = &times;
  MotionCheck check(world->snapshot->scene, options_, motion, wanted, memory_);
  std::unique_ptr<PlannedMarkers> markers;
  if (marker_publisher_ && marker_publisher_.getNumSubscribers() > 0)
    markers = std::make_unique<PlannedMarkers>(world->description());
  const auto checkPiece = [&] {
    const QueryPiece piece(turns_, limits_.seconds, work);
    arena_.run([&] {
      const CycleMotion& checked = check.next();
      if (markers) markers->add(checked);
    });
  };
  while (!check.isDone()) doPiece(checkPiece, times, world->scene(), work);
  const CycleResult result = check.result();
  response.message =
      result.pairs.empty() ? "no pairs: there is nothing to check" : firstOf(motion.notes, motion.notes.size(), "; ");
  for (const AssumedJoint& joint : motion.assumed) {
    response.assumed_joints.name.push_back(joint.name);
    response.assumed_joints.position.push_back(joint.position);
  }
  response.verdict = numberOf(result.verdict);
  response.error_bound = toErrorBound(result.error);
  response.margin = request.margin;
  const CycleContext context{world->scene(), check.ends(), motion.samples, ros::Time()};
  setPairContacts(
      result, context, [](const PairResult&) { return true; }, response.pairs);
  if (markers) marker_publisher_.publish(markers->draw(result, context, history_.fixedFrame()));
  response.checked = result.checked + result.skipped;
  response.not_checked = result.not_checked;
  return !awaitsForces(result, world->scene().bodies);
}

void Queries::checkMotions(const QueryMotions::Request& request, QueryMotions::Response& response, QueryWork& work) {
  const std::size_t count = request.motions.size();
  requireAtMost(limits_.motions, count, "motions");
  const std::string frame = rootFrameOf(request.motions);  // one, so that tf is queried once
  std::size_t points = 0;
  for (const RobotMotion& motion : request.motions) points += pointsOf(motion);
  requireAtMost(limits_.points, points, "points of motions");
  const std::shared_ptr<const CheckedWorld> world = currentWorld(response.scene_version);
  const Scene& scene = world->scene();
  const PlannedScene from_now = planned(*world, frame, static_cast<bool>(request.allow_beyond_limits));
  MotionsRequest wanted;
  wanted.first_only = !request.all;
  wanted.margin = request.margin;
  wanted.list_pairs = request.list_pairs;
  PairTimes times(scene.pairs.size());
  wanted.times = &times;
  const std::size_t per_piece = kMotionsPerThread * arena_.threads();
  MotionNotes notes;
  std::size_t listed = 0;  // pairs
  const auto checkFrom = [&](std::size_t first) {
    const QueryPiece piece(turns_, limits_.seconds, work);
    const CancelPoint cancel;
    const auto motionOf = [&](std::size_t i, double tolerance) {
      const TaskCancelScope scope(cancel);  // this may run in another thread
      MotionSampling sampling = sampling_;
      sampling.tolerance = tolerance;
      try {
        PlannedMotion motion = toPlannedMotion(request.motions[first + i], from_now, sampling);
        for (const std::string& note : motion.notes) notes.add(first + i, note);
        return motion;
      } catch (const std::invalid_argument& error) {
        refuse("motion " + std::to_string(first + i) + ": " + error.what());
      }
    };
    std::vector<MotionVerdict> verdicts;
    arena_.run([&] {
      verdicts =
          sdf_ccd::checkMotions(world->snapshot->scene, options_, std::min(per_piece, count - first), motionOf, wanted);
    });
    for (const MotionVerdict& verdict : verdicts) {
      for (const UncheckedPair& pair : verdict.unchecked)
        notes.add(response.motions.size(), pairName(scene, pair) + ": " + pair.reason);
      listed += verdict.pairs.size();
      response.motions.push_back(toCheckedMotion(verdict, scene));
    }
    requireAtMost(limits_.pairs, listed, "listed pairs");
  };
  for (std::size_t first = 0; first < count; first += per_piece) doPiece([&] { checkFrom(first); }, times, scene, work);
  response.margin = request.margin;
  response.message = notes.text();
}

}  // namespace sdf_ccd
