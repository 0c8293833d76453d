#include "ros/monitor/queries.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "common/cancel_point.h"
#include "common/counted.h"
#include "common/number_text.h"
#include "common/refuse.h"
#include "common/seconds_since.h"
#include "monitor/nearest_body.h"
#include "monitor/pair_times.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "ros/messages/conversions.h"
#include "ros/messages/planned_markers.h"
#include "ros/monitor/low_priority.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

constexpr double kWaitForForces = 0.5;                // share of a request's time
constexpr std::chrono::milliseconds kPollPeriod(10);  // of the wait
constexpr std::size_t kPointsPerPiece = 500;
constexpr std::size_t kMotionsPerThread = 16;  // in one piece, so that all threads have work in each
constexpr double kLong = 0.05;                 // after answers that take longer, freed memory is returned [s]
constexpr int kKeptByHeap = 1 << 20;           // at the end of each thread's heap: 64 MB by themselves [bytes]

std::chrono::steady_clock::duration durationOf(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

void requireAtMost(std::size_t limit, std::size_t given, const std::string& what) {
  if (given <= limit) return;
  refuse(std::to_string(given) + " " + what + ": at most " + std::to_string(limit) + " are allowed in one request");
}

/// Nothing is known of what an outdated map has around the robot.
void requireCurrentMap(const CheckedWorld& world) {
  if (world.map_age && world.map_age->isTooOld(ros::Time::now())) refuse(world.map_age->text());
}

std::size_t pointsOf(const QueryMotions::Request& request) {
  std::size_t points = 0;
  for (const RobotMotion& motion : request.motions)
    points += motion.joint_trajectory.points.size() + motion.multi_dof_joint_trajectory.points.size();
  return points;
}

/// The frame of all root poses; empty if no motion names one.
std::string rootFrameOf(const QueryMotions::Request& request) {
  std::string frame;
  for (const RobotMotion& motion : request.motions) {
    const std::string& of_motion = motion.multi_dof_joint_trajectory.header.frame_id;
    if (!frame.empty() && !of_motion.empty() && of_motion != frame)
      refuse(fmt::format("the root poses of all motions must be in the same frame, but are in {} and {}", frame,
                         of_motion));
    if (!of_motion.empty()) frame = of_motion;
  }
  return frame;
}

/// One of the motions as a request of its own.
QueryMotion::Request requestOf(const QueryMotions::Request& request, std::size_t motion) {
  QueryMotion::Request one;
  one.joint_trajectory = request.motions[motion].joint_trajectory;
  one.multi_dof_joint_trajectory = request.motions[motion].multi_dof_joint_trajectory;
  one.interpolation = request.interpolation;
  one.other_joints = request.other_joints;
  one.other_positions = request.other_positions;
  one.allow_beyond_limits = request.allow_beyond_limits;
  return one;
}

CheckedMotion toCheckedMotion(const MotionVerdict& verdict, const Scene& scene) {
  CheckedMotion message;
  message.verdict = numberOf(verdict.verdict);
  message.error_bound = verdict.error_bound;
  if (verdict.pair >= 0) {
    const PlannedPair& pair = scene.pairs[static_cast<std::size_t>(verdict.pair)];
    message.body_a = scene.bodies[pair.body_a].name;
    message.body_b = scene.bodies[pair.body_b].name;
  }
  message.time = ros::Duration(verdict.time);
  for (const PairVerdict& pair : verdict.pairs) {
    CheckedPair& listed = message.pairs.emplace_back();
    listed.body_a = scene.bodies[pair.body_a].name;
    listed.body_b = scene.bodies[pair.body_b].name;
    listed.verdict = numberOf(pair.verdict);
    listed.time = ros::Duration(pair.time);
  }
  return message;
}

/// Does the work; if it is cancelled, says what it was at.
template <class Work, class Report>
void orElse(const Work& work, const Report& report) {
  try {
    work();
  } catch (const Cancelled&) {
    report();
    throw;
  }
}

/// Notes on several motions: each text once, with the first motion that it is about. Threads may add at once.
class MotionNotes {
 public:
  void add(std::size_t motion, const std::string& note) {
    if (note.empty()) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [known, is_new] = first_.emplace(note, motion);
    if (!is_new) known->second = std::min(known->second, motion);
  }

  std::string text() const {
    constexpr std::size_t kMost = 5;
    std::string text;
    std::size_t listed = 0;
    for (const auto& [note, motion] : first_) {
      if (listed++ == kMost) return text + "; ...";
      text += (text.empty() ? "motion " : "; motion ") + std::to_string(motion) + ": " + note;
    }
    return text;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::size_t> first_;
};

}  // namespace

class Queries::Piece {
 public:
  /// @param spent  time of the answer so far, without waiting [s].
  /// @throws Cancelled if the answer takes too long; so does the work of the piece.
  Piece(Queries& queries, double& spent) : Piece(queries, spent, queries.limits_.seconds) {}

  /// @param seconds  that the answer may take instead.
  Piece(Queries& queries, double& spent, double seconds)
      : turn_(queries.turns_), spent_(spent), start_(Clock::now()), deadline_(start_ + durationOf(seconds - spent)) {
    checkCancelled();
  }
  ~Piece() { spent_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = CancelRequest::Clock;

  WorkTurns::Turn turn_;
  double& spent_;
  Clock::time_point start_;
  CancelScope deadline_;
};

/// Answers with `work`, or with the reason why there is no answer.
template <class Response, class Work>
void Queries::answerWith(const Work& work, Response& response) {
  lowerPriority();
  const auto start = std::chrono::steady_clock::now();
  const CancelPoint caller;
  const auto fail = [&](const std::string& why) {
    const std::uint64_t version = response.scene_version;
    response = {};
    response.scene_version = version;
    response.message = why;
  };
  std::string used_by;  // what took most of the time
  try {
    const CancelScope scope(std::chrono::steady_clock::now() + durationOf(request_time_));
    const WorkTurns::Caller registered(turns_);
    work(used_by);
    response.success = true;
  } catch (const Cancelled&) {
    if (caller.requested()) throw;
    const std::string by = used_by.empty() ? "" : ", most of it for " + used_by;
    if (secondsSince(start) >= request_time_) {
      fail("the request has taken longer than " + numberText(request_time_) + " s (parameter request_time)" + by);
    } else {
      fail("the request takes more than " + numberText(limits_.seconds) + " s" + by +
           ": split it into parts, or send it again when the computer is less busy");
    }
  } catch (const std::exception& error) {
    fail(error.what());
  }
  if (secondsSince(start) > kLong) malloc_trim(0);
}

Queries::Queries(std::shared_ptr<const CheckedWorld> world, const DescribedScene& described,
                 const MonitorParameters& parameters, const TfHistory& history, const QueryLimits& limits)
    : world_(std::move(world)),
      robot_(described.robot),
      tf_prefix_(described.tf_prefix),
      base_joint_(described.base_joint),
      sampling_(parameters.tf.sampling),
      options_(parameters.monitor),
      max_points_(parameters.max_points),
      refine_(parameters.refine),
      max_age_(parameters.tf.max_latency),
      history_(history),
      limits_(limits),
      request_time_(parameters.request_time),
      turns_(limits.queries, "queries are being answered") {
  mallopt(M_TRIM_THRESHOLD, kKeptByHeap);
}

void Queries::setWorld(std::shared_ptr<const CheckedWorld> world) {
  const std::lock_guard<std::mutex> lock(world_mutex_);
  world_.swap(world);
}

std::shared_ptr<const CheckedWorld> Queries::world() const {
  const std::lock_guard<std::mutex> lock(world_mutex_);
  return world_;
}

void Queries::answer(const QueryMotion::Request& request, QueryMotion::Response& response) {
  answerWith([&](std::string& used_by) { checkMotion(request, response, used_by); }, response);
}

/// The present poses, for everything that a motion does not specify.
/// @param plan_frame  frame of the plan's root poses.
PlannedScene Queries::planFromNow(const std::string& plan_frame, const CheckedWorld& world) const {
  requireCurrentMap(world);
  CurrentPoses now = currentPoses(history_, {*robot_, tf_prefix_}, world.scene());
  posesAt(history_, world.bodies, ros::Time(), now.X_WB, now.missing);
  const std::string frame = withoutLeadingSlash(plan_frame);
  history_.lookup(frame.empty() ? history_.fixedFrame() : frame, ros::Time(), now.X_WM, now.plan_frame_missing);
  return {world.scene(), *robot_, base_joint_, now, sampling_};
}

PlannedMotion Queries::plan(const QueryMotion::Request& request, const CheckedWorld& world) const {
  const PlannedScene from_now = planFromNow(request.multi_dof_joint_trajectory.header.frame_id, world);
  PlannedMotion planned = toPlannedMotion(request, from_now);
  const std::string old = ros::Time::isValid() ? oldTransformsNote(from_now.now, ros::Time::now(), max_age_) : "";
  if (!old.empty()) planned.notes += (planned.notes.empty() ? "" : "; ") + old;
  return planned;
}

void Queries::checkMotion(const QueryMotion::Request& request, QueryMotion::Response& response, std::string& used_by) {
  requireAtMost(
      limits_.waypoints,
      request.joint_trajectory.points.size() + request.multi_dof_joint_trajectory.points.size() + request.poses.size(),
      "waypoints");
  const auto start = std::chrono::steady_clock::now();
  double spent = 0.0;
  while (!checkOnce(request, response, used_by, spent)) {
    if (secondsSince(start) > kWaitForForces * request_time_) {
      response.message +=
          (response.message.empty() ? "" : "; ") + std::string("forces of some contacts are not known yet");
      return;
    }
    const std::uint64_t version = response.scene_version;
    while (world()->version() == version && secondsSince(start) <= kWaitForForces * request_time_) {
      checkCancelled();
      std::this_thread::sleep_for(kPollPeriod);
    }
    response = {};
  }
}

/// @return false if forces of a contact are awaited (Forces::kAwaited).
bool Queries::checkOnce(const QueryMotion::Request& request, QueryMotion::Response& response, std::string& used_by,
                        double& spent) {
  std::shared_ptr<const CheckedWorld> world;
  PlannedMotion planned;
  {
    const Piece piece(*this, spent);
    world = this->world();  // only now, as this may have waited
    response.scene_version = world->version();
    planned = plan(request, *world);
  }
  CycleRequest wanted;
  wanted.max_points = max_points_;
  wanted.refine = refine_;
  wanted.margin = request.margin;
  PairTimes times(world->scene().pairs.size());
  wanted.times = &times;
  MotionCheck check(world->snapshot->scene, options_, planned, wanted, memory_);
  std::unique_ptr<PlannedMarkers> markers;
  if (marker_publisher_ && marker_publisher_.getNumSubscribers() > 0)
    markers = std::make_unique<PlannedMarkers>(world->description());
  const auto checkPiece = [&] {
    const Piece piece(*this, spent);
    arena_.run([&] {
      const CycleMotion& motion = check.next();
      if (markers) markers->add(motion);
    });
  };
  while (!check.isDone()) orElse(checkPiece, [&] { used_by = times.longest(world->scene()); });
  const CycleResult result = check.result();
  response.message = result.pairs.empty() ? "no pairs: there is nothing to check" : planned.notes;
  for (const AssumedJoint& joint : planned.assumed) {
    response.assumed_joints.push_back(joint.name);
    response.assumed_positions.push_back(joint.position);
  }
  response.verdict = numberOf(result.verdict);
  response.error_bound = toErrorBound(result.error);
  response.margin = request.margin;
  const CycleContext context{world->scene(), check.ends(), planned.samples, ros::Time()};
  setPairContacts(
      result, context, [](const PairResult&) { return true; }, response.pairs);
  if (markers) marker_publisher_.publish(markers->draw(result, context, history_.fixedFrame()));
  response.checked = result.checked + result.skipped;
  response.not_checked = result.not_checked;
  return std::none_of(result.pairs.begin(), result.pairs.end(), [&](const PairResult& pair) {
    const BodyList& bodies = world->scene().bodies;
    return pair.on_a_W.force.hasNaN() && (bodies[static_cast<std::size_t>(pair.body_a)].forces == Forces::kAwaited ||
                                          bodies[static_cast<std::size_t>(pair.body_b)].forces == Forces::kAwaited);
  });
}

void Queries::answer(const QueryMotions::Request& request, QueryMotions::Response& response) {
  answerWith([&](std::string& used_by) { checkMotions(request, response, used_by); }, response);
}

void Queries::checkMotions(const QueryMotions::Request& request, QueryMotions::Response& response,
                           std::string& used_by) {
  const std::size_t count = request.motions.size();
  requireAtMost(limits_.motions, count, "motions");
  const std::string frame = rootFrameOf(request);  // one, so that tf is queried once
  requireAtMost(limits_.points, pointsOf(request), "points of motions");
  const std::shared_ptr<const CheckedWorld> world = this->world();
  response.scene_version = world->version();
  const Scene& scene = world->scene();
  const PlannedScene from_now = planFromNow(frame, *world);
  MotionsRequest wanted;
  wanted.first_only = !request.all;
  wanted.margin = request.margin;
  wanted.list_pairs = request.list_pairs;
  wanted.refine = refine_;
  PairTimes times(scene.pairs.size());
  wanted.times = &times;
  const std::size_t per_piece = kMotionsPerThread * arena_.threads();
  MotionNotes notes;
  std::size_t listed = 0;  // pairs
  double spent = 0.0;
  const auto checkFrom = [&](std::size_t first) {
    const Piece piece(*this, spent);
    const CancelPoint cancel;
    const auto motionOf = [&](std::size_t i, double tolerance) {
      const TaskCancelScope scope(cancel);  // this may run in another thread
      PlannedScene now = from_now;
      now.sampling.tolerance = tolerance;
      try {
        PlannedMotion planned = toPlannedMotion(requestOf(request, first + i), now);
        notes.add(first + i, planned.notes);
        return planned;
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
  for (std::size_t first = 0; first < count; first += per_piece)
    orElse([&] { checkFrom(first); }, [&] { used_by = times.longest(scene); });
  response.margin = request.margin;
  response.message = notes.text();
}

void Queries::answer(const QueryPoints::Request& request, QueryPoints::Response& response) {
  answerWith([&](std::string&) { findDistances(request, response); }, response);
}

void Queries::findDistances(const QueryPoints::Request& request, QueryPoints::Response& response) {
  requireAtMost(limits_.points, request.points.size(), "points");
  const std::string frame =
      request.header.frame_id.empty() ? history_.fixedFrame() : withoutLeadingSlash(request.header.frame_id);
  const std::shared_ptr<const CheckedWorld> world = this->world();
  const Scene& scene = world->scene();
  response.scene_version = world->version();
  requireCurrentMap(*world);
  Isometry3d X_WQ;
  std::string problem;
  if (!history_.lookup(frame, request.header.stamp, X_WQ, problem)) refuse(problem);
  std::vector<Isometry3d> X_WB;
  std::vector<std::string> missing;
  posesAt(history_, world->bodies, request.header.stamp, X_WB, missing);
  NearestBodySearch search(world->snapshot->scene, world->snapshot->description, meshes_);
  for (std::size_t body = 0; body < missing.size(); ++body) {
    const Body& description = scene.bodies[body];
    if (description.failure.empty() && !missing[body].empty())
      refuse("body " + description.name + ": " + missing[body]);
    double preparing = 0.0;  // what was prepared once is kept
    const Piece piece(*this, preparing, request_time_);
    const std::string doubt = search.prepare(body);
    if (doubt.empty()) continue;
    const std::string line = "body " + description.name + ": " + doubt;
    if (search.isIgnored(body)) {
      response.message += line + "\n";
    } else if (doubts_.insert(line).second) {
      ROS_WARN("query_points: %s", line.c_str());
    }
  }
  double spent = 0.0;
  for (std::size_t first = 0; first < request.points.size(); first += kPointsPerPiece) {
    const Piece piece(*this, spent);
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
