#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/model.h>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

using JointPositions = std::map<std::string, double>;  ///< by joint name [rad or m]

/// By joint name: pose of the joint's child link in the joint's frame (the one that its `origin` gives).
using JointPoses = std::map<std::string, Isometry3d>;

/// The tree of links and joints of a URDF.
class RobotModel {
 public:
  /// @param source  where the text is from, for errors; may be empty.
  /// What is wrong with one joint or link costs no other: the joint floats or follows none, as warnings() tell.
  /// @throws std::runtime_error, with the source and the parser's reason, if the text is no URDF.
  explicit RobotModel(const std::string& urdf_xml, const std::string& source = {});

  /// As the parser has read it.
  const urdf::ModelInterface& urdf() const { return *urdf_; }
  /// Name of the root link.
  const std::string& root() const { return root_; }

  /// Links in depth-first order, the root first.
  const std::vector<std::string>& links() const { return links_; }

  /// A link's index in links(); −1 if it has none of that name.
  int find(const std::string& link) const;

  /// Parent of a link, by its index in links(); −1 for the root.
  int parent(int link) const { return parent_[link]; }

  /// The joint between a link and its parent, by the link's index in links(); not of the root, which has none.
  const urdf::Joint& jointAbove(int link) const;

  /// The joint that a mimic joint follows in the end; for any other joint the joint itself.
  const urdf::Joint& leader(const urdf::Joint& joint) const;

  /// Change of the joint's position per change of its leader's; 1 for a joint without leader.
  double multiplier(const urdf::Joint& joint) const;

  /// Links whose collision elements urdf() lacks because the parser could not read all of them, with the reasons.
  const std::map<std::string, std::string>& unread() const { return unread_; }

  /// Errors in the URDF for which another meaning was assumed, one per line.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Pose of every link in the root's frame, in the order of links().
  ///
  /// Joints that are not named are at zero (or at the nearest limit), planar and floating ones at identity. Mimic
  /// joints that are not named follow their leader. Named positions are used as they are, also beyond the joint's
  /// limits. They are along the unit axis, whatever the length of the axis in the URDF.
  /// @param poses  of joints of any type; they take precedence over positions.
  /// @throws std::invalid_argument for a joint that does not exist, or a position or pose that is not finite.
  std::vector<Isometry3d> forwardKinematics(const JointPositions& positions, const JointPoses& poses = {}) const;

  /// Position of a joint: its own or from its leader, else zero or the nearest limit.
  double position(const urdf::Joint& joint, const JointPositions& positions) const;

  /// True if only fixed joints lie between the links.
  bool rigidlyJoined(const std::string& link_a, const std::string& link_b) const;

  /// True if no other link with a collision shape, read or not, lies between the links.
  bool neighbours(const std::string& link_a, const std::string& link_b) const;

  /// True if a movable joint, neither planar nor floating, connects the two links themselves. Links that are farther
  /// apart in the tree may be apart in space, too, whatever lies between them: an arm may hit a mast beside its base.
  bool adjacent(const std::string& link_a, const std::string& link_b) const;

  /// Upper bound of the distance between a point of link A and one of link B, each in its link's frame, over all joint
  /// positions [m]; infinite if a floating, planar or unlimited prismatic joint is between them.
  ///
  /// Revolute joints may rotate by a full revolution, because real ones overshoot their limits; prismatic joints may
  /// exceed theirs by a tenth of the range, and by at least 1 cm. Limits may be in either order; two equal ones count
  /// as none. Exact if at most one joint between the links moves; with more joints, the triangle inequality over the
  /// distances between their axes.
  /// @throws std::invalid_argument for a link that does not exist.
  double reach(const std::string& link_a, const Vector3d& p_A, const std::string& link_b, const Vector3d& p_B) const;

  /// The joint position whose pose of the child link in the parent link's frame is closest to the given one [rad or m].
  /// A pose does not determine whole revolutions: for a revolute joint, the position within its limits if there is one,
  /// else within (−π, π]. NaN for joints without exactly one degree of freedom.
  double positionAt(const urdf::Joint& joint, const Isometry3d& X_PL) const;

 private:
  std::vector<std::string> warnings_;
  std::shared_ptr<urdf::ModelInterface> urdf_;
  std::string root_;
  std::map<std::string, std::string> unread_;
  std::vector<std::string> links_;
  std::map<std::string, int> index_;  ///< of a link in links_
  std::vector<int> parent_;           ///< per link: its parent's index; -1 for the root

  int indexOf(const std::string& link) const;
  void requireKnown(const JointPositions& positions, const JointPoses& poses) const;
  std::vector<std::pair<int, bool>> path(int from, int to) const;  ///< (link below the joint, whether it goes down)
  std::vector<int> jointsBetween(const std::string& link_a,
                                 const std::string& link_b) const;  ///< types of those that move
};

}  // namespace sdf_ccd
