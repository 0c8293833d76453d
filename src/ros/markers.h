#pragma once

#include <map>
#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "ros/conversions.h"

namespace sdf_ccd {

struct MarkerOptions {
  double scale = 1.0;  ///< of all markers; at 1 a contact point is a ball of 7 mm
  double hold = 0.5;   ///< how long a contact stays visible after the cycle that found it [s]
};

/// Draws contacts: points, normals, depth, the way of the contact points during the cycle, and a text.
class MarkerDrawer {
 public:
  MarkerDrawer(const std::string& fixed_frame, const MarkerOptions& options)
      : fixed_frame_(fixed_frame), options_(options) {}

  /// Markers of all pairs that touch, and deletions of those that no longer do.
  visualization_msgs::MarkerArray draw(const CycleResult& result, const CycleContext& cycle);

  /// Deletes everything.
  visualization_msgs::MarkerArray clear();

 private:
  void drawPair(int id, const PairResult& pair, const CycleContext& cycle, visualization_msgs::MarkerArray& markers);
  void drawText(int id, const PairResult& pair, const CycleContext& cycle, visualization_msgs::MarkerArray& markers);
  visualization_msgs::Marker marker(const char* name, int id, int type) const;

  std::string fixed_frame_;
  MarkerOptions options_;
  std::map<int, ros::Time> shown_until_;  // by pair
};

}  // namespace sdf_ccd
