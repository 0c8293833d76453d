#pragma once

#include <map>
#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"
#include "ros/messages/robot_box.h"

namespace sdf_ccd {

struct MarkerOptions {
  double scale = 1.0;  ///< factor for all markers; at 1 a contact point is 1/130 of the robot's size, a letter 1/26
  double hold = 0.5;   ///< time for which a contact stays visible after its last cycle [s]
};

/// Draws the results of a cycle: a status text above the robot, which lists the deepest contacts by number; and for
/// each contact its points, normals and depth, the paths of its points during the cycle and, if it is listed, its
/// number. All sizes scale with the robot's. Namespaces: status, points, normals, depth, swept (ids: pairs), numbers
/// (ids: ranks).
class MarkerDrawer {
 public:
  static constexpr int kListed = 4;  ///< maximum number of contacts that are listed

  MarkerDrawer(const std::string& fixed_frame, const MarkerOptions& options)
      : fixed_frame_(fixed_frame), options_(options), states_(options.hold) {}

  void setOptions(const MarkerOptions& options) {
    options_ = options;
    states_.setHold(options.hold);
  }

  /// Markers of all pairs in contact, deletions of those no longer in contact, and the status.
  /// @param now       gives the age of the results in the status.
  /// @param warnings  for the status, as in MonitorState.
  visualization_msgs::MarkerArray draw(const CycleResult& result, const CycleContext& cycle, const ros::Time& now,
                                       const std::vector<std::string>& warnings = {});

  /// Deletes everything, and shows that nothing is checked, for this reason.
  visualization_msgs::MarkerArray clear(const std::string& reason);

  /// Switches to another world: markers of pairs that no longer exist are deleted.
  /// @param before  per pair: its former index; -1 if it is new.
  void switchPairs(const std::vector<int>& before);

  /// The states that were drawn last.
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
  int numbers_ = 0;             // count of numbers that are drawn
  bool deletes_all_ = false;    // delete all markers before drawing, as ids have changed
};

/// Raises labels of this height so that no two of them overlap, seen from any horizontal direction. Of two labels that
/// overlap, the upper one is raised.
std::vector<Vector3d> staggered(std::vector<Vector3d> positions, double height);

}  // namespace sdf_ccd
