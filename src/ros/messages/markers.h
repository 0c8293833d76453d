#pragma once

#include <map>
#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"
#include "ros/messages/robot_box.h"

namespace sdf_ccd {

struct MarkerOptions {
  double scale =
      1.0;  ///< of all markers; at 1 a contact point is a ball of 1/130 of the robot's size, a letter 1/26 high
  double hold = 0.5;  ///< how long a contact stays visible after the cycle that found it [s]
};

/// Draws what a cycle found: a status in words above the robot, which lists the deepest contacts by number; and of each
/// contact points, normals, depth, the way of the contact points during the cycle and, of those listed, the number.
/// All sizes follow the robot's. Namespaces: status, points, normals, depth, swept (ids: pairs), numbers (ids: ranks).
class MarkerDrawer {
 public:
  static constexpr int kListed = 4;  ///< contacts, at most

  MarkerDrawer(const std::string& fixed_frame, const MarkerOptions& options)
      : fixed_frame_(fixed_frame), options_(options), states_(options.hold) {}

  void setOptions(const MarkerOptions& options) {
    options_ = options;
    states_.setHold(options.hold);
  }

  /// Markers of all pairs that touch, deletions of those that no longer do, and the status.
  /// @param now  the status tells how long ago things were as they are drawn.
  visualization_msgs::MarkerArray draw(const CycleResult& result, const CycleContext& cycle, const ros::Time& now);

  /// Deletes everything, and says that nothing is checked, for this reason.
  visualization_msgs::MarkerArray clear(const std::string& reason);

  /// Goes on with another world: what is shown of pairs that are no longer there is deleted.
  /// @param before  per pair: its index until now; -1 if it is new.
  void take(const std::vector<int>& before);

  /// As it was drawn last.
  const PairStates& states() const { return states_; }

 private:
  /// A contact that is shown, also for a while after it has ended.
  struct Shown {
    ros::Time until;
    Vector3d p_W;
    std::string text;
    double depth;
  };

  void drawPair(int id, const PairResult& pair, const CycleContext& cycle, visualization_msgs::MarkerArray& markers);
  void deleteOld(const ros::Time& end, visualization_msgs::MarkerArray& markers);
  std::vector<const Shown*> deepest() const;
  void drawNumbers(const std::vector<const Shown*>& listed, visualization_msgs::MarkerArray& markers);
  visualization_msgs::Marker statusMarker(const std::string& text, Verdict verdict) const;
  visualization_msgs::Marker marker(const char* name, int id, int type) const;
  double letter() const;

  std::string fixed_frame_;
  MarkerOptions options_;
  PairStates states_;
  RobotBox box_;
  std::map<int, Shown> shown_;  // by pair
  int numbers_ = 0;             // that are drawn
  bool begins_anew_ = false;    // all that was drawn is deleted first, as ids are others now
};

/// Heights at which labels of that height do not overlap, seen from anywhere beside them: where two are near each
/// other, the upper one is raised.
std::vector<Vector3d> staggered(std::vector<Vector3d> places, double height);

}  // namespace sdf_ccd
