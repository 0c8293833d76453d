#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <urdf_model/model.h>

#include "sdf_ccd/geometry/eigen_types.h"

namespace sdf_ccd {

using JointPositions = std::map<std::string, double>;  ///< by joint name [rad or m]

/// The tree of links and joints of a URDF.
class RobotModel {
 public:
  /// @throws std::runtime_error, with the parser's reason, if the text is no URDF.
  explicit RobotModel(const std::string& urdf_xml);

  const urdf::ModelInterface& urdf() const { return *urdf_; }
  const std::string& root() const { return root_; }

  /// Links in depth-first order, the root first.
  const std::vector<std::string>& links() const { return links_; }

  /// Pose of every link in the root's frame, in the order of links(). Joints that are not named are at zero (or at
  /// the nearest limit); mimic joints follow. @throws std::invalid_argument for a joint that does not exist.
  std::vector<Isometry3d> forwardKinematics(const JointPositions& positions) const;

  /// True if only fixed joints lie between the links.
  bool rigidlyJoined(const std::string& link_a, const std::string& link_b) const;

  /// True if one movable joint, and else only fixed ones, lies between the links.
  bool adjacent(const std::string& link_a, const std::string& link_b) const;

  /// Bounds of the distance between two links' origins over all joint positions [m]: no less and no more than this.
  struct Reach {
    double nearest;
    double farthest;  ///< infinite for floating or unlimited prismatic joints
  };
  Reach reach(const std::string& link_a, const std::string& link_b) const;

 private:
  std::shared_ptr<urdf::ModelInterface> urdf_;
  std::string root_;
  std::vector<std::string> links_;
};

}  // namespace sdf_ccd
