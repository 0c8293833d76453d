#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>

#include <ros/publisher.h>

#include "monitor/nearest_body.h"
#include "monitor/shared_memory.h"
#include "motion/motion_sampling.h"
#include "ros/messages/robot_motion.h"
#include "ros/monitor/work_arena.h"
#include "ros/monitor/work_turns.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/QueryMotions.h"
#include "sdf_ccd/QueryPoints.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Limits of one query, and of the number of queries. Larger ones are refused, with the reason in the answer's message.
struct QueryLimits {
  std::size_t waypoints = 2000;  ///< of all trajectories of a motion
  std::size_t motions = 2000;    ///< of query_motions
  std::size_t points = 20000;    ///< of query_points, or of all motions of query_motions
  std::size_t pairs = 100000;    ///< listed by query_motions
  double seconds = 2.0;          ///< of computing; the answer follows within milliseconds
  int queries = 4;               ///< at a time
};

struct QueryWork;

/// Answers query_motion, query_motions and query_points in parallel to the cycles, with lower priority than these, on
/// at most half of the cores. Several calls at a time take turns. A motion is checked piece by piece, so memory does
/// not grow with its length.
///
/// A CancelScope of the calling thread ends an answer with Cancelled.
class Queries {
 public:
  Queries(std::shared_ptr<const CheckedWorld> world, const DescribedScene& described,
          const MonitorParameters& parameters, const TfHistory& history, const QueryLimits& limits = {});

  /// Answers that begin from now on use this world; earlier ones continue with theirs. May be called from any thread.
  void setWorld(std::shared_ptr<const CheckedWorld> world);

  std::shared_ptr<const CheckedWorld> world() const;

  /// Frees what was prepared of meshes that are gone.
  void dropUnused() { sdf_ccd::dropUnused(*meshes_); }

  /// Draws each motion that is checked while there is a subscriber (PlannedMarkers). Must be called before answer().
  void setMarkerPublisher(const ros::Publisher& publisher) { marker_publisher_ = publisher; }

  void answer(const QueryMotion::Request& request, QueryMotion::Response& response);
  void answer(const QueryMotions::Request& request, QueryMotions::Response& response);
  void answer(const QueryPoints::Request& request, QueryPoints::Response& response);

 private:
  template <class Request, class Response>
  using Make = void (Queries::*)(const Request& request, Response& response, QueryWork& work);
  template <class Request, class Response>
  void answerWith(Make<Request, Response> make, const Request& request, Response& response);

  std::shared_ptr<const CheckedWorld> currentWorld(std::uint64_t& version) const;
  PlannedScene planned(const CheckedWorld& world, const std::string& root_frame, bool allow_beyond_limits) const;
  void checkMotions(const QueryMotions::Request& request, QueryMotions::Response& response, QueryWork& work);
  void checkMotion(const QueryMotion::Request& request, QueryMotion::Response& response, QueryWork& work);
  bool checkOnce(const QueryMotion::Request& request, QueryMotion::Response& response, QueryWork& work);
  void findDistances(const QueryPoints::Request& request, QueryPoints::Response& response, QueryWork& work);

  mutable std::mutex world_mutex_;
  std::shared_ptr<const CheckedWorld> world_;  // guarded by world_mutex_
  std::shared_ptr<const RobotModel> robot_;
  std::string tf_prefix_, base_joint_;
  MotionSampling sampling_;
  MonitorOptions options_;
  int max_points_;
  double max_age_;  // older transforms are mentioned in a note [s]
  const TfHistory& history_;
  ros::Publisher marker_publisher_;  // if it is empty, nothing is drawn
  QueryLimits limits_;
  double request_time_;  // longest time until an answer, with all waiting [s]
  WorkTurns turns_;
  std::shared_ptr<MeshDistances> meshes_ = makeMeshDistances();
  std::set<std::string>
      doubts_;  // about bodies that errors of distances allow for, as logged; used by one answer at a time
  std::shared_ptr<MonitorMemory> memory_ = makeMonitorMemory();  // shared by all answers, as one works at a time
  WorkArena arena_;
};

}  // namespace sdf_ccd
