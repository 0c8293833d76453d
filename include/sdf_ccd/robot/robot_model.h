#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/model.h>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

using JointPositions = std::map<std::string, double>;  ///< by joint name [rad or m]

/// By joint name: pose of the joint's child link in the joint's frame (the one that its `origin` gives).
using JointPoses = std::map<std::string, Isometry3d>;

/// The tree of links and joints of a URDF.
class RobotModel {
 public:
  /// @param source  where the text is from, for errors; may be empty.
  /// @throws std::runtime_error, with the source and the parser's reason, if the text is no URDF; also for a joint
  /// whose axis is zero or that mimics a missing joint or itself.
  explicit RobotModel(const std::string& urdf_xml, const std::string& source = {});

  const urdf::ModelInterface& urdf() const { return *urdf_; }
  const std::string& root() const { return root_; }

  /// Links in depth-first order, the root first.
  const std::vector<std::string>& links() const { return links_; }

  /// Of a link, by its index in links(): that of its parent, −1 for the root; and the joint between them, which all
  /// links but the root have.
  int parent(int link) const { return parent_[link]; }
  const urdf::Joint& jointAbove(int link) const;

  /// The joint that a mimic joint follows in the end; any other joint itself.
  const urdf::Joint& leader(const urdf::Joint& joint) const;

  /// How much the joint's position changes with its leader's; 1 for a joint that follows none.
  double multiplier(const urdf::Joint& joint) const;

  /// Links whose collision elements urdf() does not hold, as the parser could not read all of them; reasons by link.
  const std::map<std::string, std::string>& unread() const { return unread_; }

  /// What the URDF says amiss and was taken in another sense, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Pose of every link in the root's frame, in the order of links().
  ///
  /// Joints that are named nowhere are at zero (or at the nearest limit), planar and floating ones at identity. Mimic
  /// joints follow their leader, also if they are named. A named position is taken as it is, also beyond the joint's
  /// limits, in units of the axis' direction, however long the axis is.
  /// @param poses  joints that stand here, of whatever type; for these, positions do not count.
  /// @throws std::invalid_argument for a joint that does not exist, or a position or pose that is not finite.
  std::vector<Isometry3d> forwardKinematics(const JointPositions& positions, const JointPoses& poses = {}) const;

  /// Where a joint is when its positions are these: its own or its leader's, else zero or the nearest limit.
  double position(const urdf::Joint& joint, const JointPositions& positions) const;

  /// True if only fixed joints lie between the links.
  bool rigidlyJoined(const std::string& link_a, const std::string& link_b) const;

  /// True if one movable joint, and else only fixed ones, lies between the links. Planar and floating joints hold
  /// nothing together: links on either side of one are not adjacent.
  bool adjacent(const std::string& link_a, const std::string& link_b) const;

  /// Bounds of the distance between two links' origins over all joint positions [m]: no less and no more than this.
  struct Reach {
    double nearest;
    double farthest;  ///< infinite for floating, planar or unlimited prismatic joints
  };

  /// Every revolute joint may turn all the way round: real ones overshoot their limits. Prismatic joints may exceed
  /// theirs by a tenth of the range, and by 1 cm at least (slidesBetween()); beyond that nothing holds, and who leaves
  /// pairs out for it must see to it. Limits count either way round; two equal ones are taken for none. An axis' length
  /// does not matter. That the links are joined as the URDF says is taken for granted.
  /// Exact if at most one joint between the links moves; with more, the triangle inequality over the distances
  /// between their axes.
  /// @throws std::invalid_argument for a link that does not exist.
  Reach reach(const std::string& link_a, const std::string& link_b) const;

  /// The same between a point of link A and one of link B, each in its link's frame [m].
  Reach reach(const std::string& link_a, const Vector3d& p_A, const std::string& link_b, const Vector3d& p_B) const;

  /// A prismatic joint, and the positions that reach() allows for [m].
  struct Slide {
    std::string joint;
    double low;
    double high;
  };
  std::vector<Slide> slidesBetween(const std::string& link_a, const std::string& link_b) const;

  /// The position at which a joint comes nearest to having its child link there in its parent link's frame [rad or m];
  /// of a revolute joint the one within its limits, where there is one, else within (−π, π]: a pose does not tell whole
  /// revolutions. NaN for joints of other degrees of freedom than one.
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
