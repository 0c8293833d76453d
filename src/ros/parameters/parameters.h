#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "common/settings/setting.h"
#include "monitor/map/voxel_map.h"
#include "monitor/proximity.h"
#include "robot/world_shapes.h"
#include "robot_monitor/overlapping_pairs.h"
#include "robot_monitor/request_permissions.h"
#include "robot_monitor/robot_pair_traits.h"
#include "ros/messages/markers.h"
#include "ros/tf/cycle_trigger.h"
#include "ros/tf/tf_tracker.h"
#include "scene/pair_rules.h"
#include "sdf_ccd/distances.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Distances to watch, which can change while the monitor runs.
struct ProximityParameters {
  double report_distance = 0.0;  ///< pairs nearer than this are listed [m]; 0: none
  ProximityThresholds thresholds;
  std::vector<PairLimit> pairs;            ///< that may come nearer, or less near, than others
  std::optional<StoppingPromise> promise;  ///< of the robot that obeys the velocity scale; none: it is not published
};

/// The world as an OctoMap received on a topic, also from the parameters `octomap/…`.
struct LiveMapParameters {
  std::string topic;  ///< empty: none
  UnknownSpace unknown = UnknownSpace::kFree;
  double unknown_distance = 0.5;  ///< [m]
  double padding = 0.03;          ///< by which the robot is enlarged to find its own voxels [m]
  double max_age = 0.0;           ///< the robot is NOT_CHECKED against maps received longer ago [s]; 0: no limit
};

/// All parameters of the monitor; config/monitor.yaml documents them.
struct MonitorParameters {
  std::string urdf_parameter;  ///< name of the parameter that holds the robot's description
  std::string srdf_parameter;
  std::string urdf;         ///< text of the robot's description
  std::string srdf;         ///< text of its semantic description, empty if there is none
  std::string urdf_source;  ///< origin of those texts, for error messages
  std::string srdf_source;
  std::string urdf_file;    ///< absolute; meshes with relative names are beside it. Empty: in the working directory
  std::string fixed_frame;  ///< empty: the robot's root link
  std::string tf_prefix;
  RobotPairOptions robot;
  PairRules pairs;
  OverlapRule::Kind overlapping_pairs = OverlapRule::Kind::kNeighbours;
  enum class Wrenches { kAlways, kOnDemand, kNever };
  Wrenches wrenches = Wrenches::kAlways;
  std::vector<WorldObject> world;
  std::string world_file;                   ///< further objects; empty: none
  std::vector<std::string> resource_roots;  ///< folders whose files requests may name
  double request_time = 10.0;               ///< longest time until the answer to a request [s]
  RequestPermissions requests;
  std::optional<WorldObject> octomap;  ///< from a file; an empty frame: the fixed frame
  LiveMapParameters live_map;
  BodyOptions scene;
  MonitorOptions monitor;
  ContactJoin contact_join{std::chrono::milliseconds(100), 5e-4};
  bool log_contacts = true;  ///< see ContactLog
  TfTrackerOptions tf;
  MarkerOptions markers;
  ProximityParameters proximity;
  double rate = 0.0;            ///< [Hz]
  double max_cycle_time = 0.0;  ///< as the parameter: see cycleTimeLimit()
  TriggerOptions trigger;
  int max_points = 0;
  /// Parameters that nothing reads: those that are gone, with their successors, and unknown ones, with suggestions.
  /// Unknown ones in groups are errors.
  std::vector<std::string> unused;
};

/// CycleRequest::max_time of a running monitor [s]; bags and queries have no such limit, so that their results do not
/// depend on the load of the machine.
double cycleTimeLimit(const MonitorParameters& parameters);

/// What max_cycle_time may be, if this value is not; else empty.
std::string whyNoCycleTime(double max_cycle_time);

/// Thrown while the robot's description is not set; it may be set later.
struct MissingDescription : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads and checks all parameters but the descriptions, which are left empty.
/// @param name  of the tree, for errors: "/collision_monitor".
/// @throws std::runtime_error naming the parameter and its value.
MonitorParameters parseParameters(Setting tree, const std::string& name);

/// Reads and checks all parameters from a private namespace, with the robot's descriptions.
/// @throws MissingDescription, else std::runtime_error naming the parameter and its value.
MonitorParameters readParameters(const ros::NodeHandle& private_node);

}  // namespace sdf_ccd
