#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/monitor.h"
#include "sdf_ccd/result.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/segments.h"
#include "sdf_ccd/trajectory.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// How a RobotScene is made.
struct RobotSceneOptions {
  /// Bodies that stay farther apart than this are CLEAR; those that come closer may be UNCERTAIN [m]. From kMinMaxError
  /// to kLargestMaxError.
  double max_error = 1e-4;

  /// Whether fields and shells are made, which give forces: most of the time that loading takes. Without them wrenches
  /// are NaN, and of bodies without a certain solid (open meshes) only some times and a bound of the depth are known.
  bool measure_contacts = true;
  /// Maximum distance of a surface location to a point that produces forces [m]; none: by the sizes of the bodies, at
  /// most 5 mm.
  std::optional<double> contact_spacing = {};
  ContactOptions contact = {};  ///< the contact model, for forces

  /// Pairs that may touch, and so are not checked, by names or patterns (* for any text, ? for any character). An SRDF
  /// names such pairs, too.
  std::vector<std::pair<std::string, std::string>> allowed_pairs = {};
  /// Pairs that are checked although `allowed_pairs`, the SRDF or one of the rules below leaves them out, in the same
  /// form.
  std::vector<std::pair<std::string, std::string>> checked_pairs = {};
  bool check_adjacent = false;  ///< also check links that a movable joint connects

  /// Whether links that overlap with all joints at zero, with at most two movable joints between them, or that overlap
  /// in all of 200 random states, are checked all the same. Else warnings() name them: their contacts are not seen.
  bool check_overlapping_pairs = false;

  std::string cache_directory = {};  ///< of fields and shells; empty: no cache

  /// Reads meshes; null: loadLocalResource() with packagesFromEnvironment(). Relative names are then beside the URDF,
  /// or in the working directory if the URDF is a text.
  ResourceLoader loader = {};
};

/// What is wanted from the check of a motion.
struct MotionCheckOptions {
  /// Only pairs that stay farther apart than this are CLEAR; those that come closer are UNCERTAIN, and so are contacts
  /// that are less deep [m]. From 0 to kLargestMargin.
  double margin = 0.0;

  bool contacts = true;              ///< times and depths of contacts; verdicts alone cost less
  bool wrenches = true;              ///< of contacts
  int max_points = 0;                ///< contact points listed per pair, the deepest first
  bool allow_beyond_limits = false;  ///< accept positions beyond joints' limits
};

/// Two bodies along a motion. Times are those of the trajectory [s].
struct MotionPair {
  std::string body_a, body_b;  ///< names of links or objects
  Verdict verdict = Verdict::kNotChecked;
  std::string reason;        ///< why it is NOT_CHECKED, or has no force (wrenches are NaN); else empty
  double error_bound = 0.0;  ///< of the verdict [m]

  Intervals contacts;  ///< during which they touch; increasing

  /// The bodies are apart before `enter`, and certainly touch by `exit`, which is infinite if no certain contact was
  /// found. Only of bodies whose depths are measured on triangles, and not if one may be inside the other at the start.
  std::optional<Interval> first_contact;

  /// The deepest contact, with its time, depth and error; only if there are contacts. Its location and normal are in
  /// the world, the normal from A to B.
  ContactPoint deepest;
  std::vector<ContactPoint> points;  ///< MotionCheckOptions::max_points

  /// Mean over the whole motion, world axes, about the origin of the body's frame at the end of the motion: that of the
  /// link, or of the object.
  ///@{
  Wrench on_a_W, on_b_W;
  ///@}
};

/// What a motion does.
struct MotionResult {
  /// The worst of all pairs: CONTACT, UNCERTAIN, NOT_CHECKED, CLEAR; NOT_CHECKED if there are no pairs.
  Verdict verdict = Verdict::kNotChecked;
  double error_bound = 0.0;  ///< the largest of the pairs that were checked [m]

  /// All pairs of the scene: those that are not CLEAR first, by severity, then by the time of their first contact.
  std::vector<MotionPair> pairs;

  std::vector<AssumedJoint> assumed;  ///< joints that the trajectory does not name, where setJoints() has them
  std::vector<std::string> notes;     ///< about these, for the user; one line each

  /// The pair of two bodies, in either order; null if the scene leaves it out.
  const MotionPair* find(const std::string& body_a, const std::string& body_b) const;
};

/// What one of several motions does first.
struct MotionSummary {
  Verdict verdict = Verdict::kNotChecked;  ///< as MotionResult::verdict, or that of the motion's first part that is not
                                           ///< CLEAR: with a later contact it may be UNCERTAIN
  double error_bound = 0.0;                ///< [m]
  std::string body_a, body_b;              ///< the first pair with the verdict; empty if that is CLEAR
  /// At which the pair touches, or else the begin of the part of the motion with the verdict [s], in the trajectory's
  /// time; NaN if that is CLEAR.
  double time = std::numeric_limits<double>::quiet_NaN();
};

/// The distance of two bodies.
struct BodyDistance {
  std::string body_a, body_b;              ///< names of links or objects; empty if there is no pair to measure
  Verdict verdict = Verdict::kNotChecked;  ///< of this pair
  std::string reason;                      ///< why it is NOT_CHECKED; else empty

  /// [m]; 0 if they touch, NaN if that is not known.
  double distance = std::numeric_limits<double>::quiet_NaN();
  double error = 0.0;  ///< bound on the error of `distance` [m]

  /// The points of A and of B that are nearest to each other [m], in the world. If the bodies touch: where that is.
  ///@{
  Vector3d point_a = Vector3d::Zero(), point_b = Vector3d::Zero();
  ///@}
  Vector3d normal = Vector3d::Zero();  ///< unit, from A to B, in the world; zero if it is not known

  double depth = 0.0;        ///< of the deepest point if they touch [m]
  double depth_error = 0.0;  ///< of `depth` [m]
};

/// A robot among objects: its links are checked against each other and against the objects, along trajectories or
/// where the joints are. Bodies are named as in the URDF and in the world.
///
/// Frames: the world W, in which RobotState::X_WR has the robot's root link, by default at the identity. Objects
/// without a frame do not move in the world; others move with the link that their frame names.
///
/// What is not proved is UNCERTAIN; what is not known is NOT_CHECKED, with the reason: a link or object whose mesh
/// cannot be read (warnings() name it), and what a joint moves that neither a trajectory nor setJoints() names.
///
/// Any number of threads may call const functions at the same time; calls of others need the scene for themselves.
/// Work runs on the caller's TBB arena, and ends with Cancelled if a CancelScope says so.
class RobotScene {
 public:
  /// Reads a robot from files.
  /// @param urdf_file  relative names of meshes are beside it; package:// is looked up in ROS_PACKAGE_PATH.
  /// @param srdf_file  pairs of links that are not checked; empty: none.
  /// @param world      objects; one whose shapes cannot be read or are not valid is NOT_CHECKED, as a link is.
  /// @throws std::runtime_error, naming the file and the reason, if one cannot be read or is no URDF or SRDF;
  /// std::invalid_argument for options, and for an object whose name, frame or pose addObject() would refuse;
  /// Cancelled.
  static RobotScene load(const std::string& urdf_file, const std::string& srdf_file = {},
                         const std::vector<WorldObject>& world = {}, const RobotSceneOptions& options = {});

  /// The same from texts.
  static RobotScene parse(const std::string& urdf_xml, const std::string& srdf_xml = {},
                          const std::vector<WorldObject>& world = {}, const RobotSceneOptions& options = {});

  /// A scene that was moved from can only be assigned to, or destroyed.
  ///@{
  RobotScene(RobotScene&&) noexcept;
  RobotScene& operator=(RobotScene&&) noexcept;
  ///@}
  ~RobotScene();

  /// Its links and joints.
  const RobotModel& robot() const;

  /// What the user should know of what the scene does not check, or reads otherwise than it may be meant; one line
  /// each. Empty: nothing.
  const std::vector<std::string>& warnings() const;

  /// A table of all bodies with what was built for them, below it what is not checked or left out, and why.
  std::string planText() const;

  /// Names of the pairs that are checked.
  std::vector<std::pair<std::string, std::string>> pairs() const;

  /// Where the joints are that a trajectory, or the positions given to distance(), do not name. Replaces all that was
  /// said before. Mimic joints follow their leader.
  /// @throws std::invalid_argument for a joint that does not exist, and a position or pose that is not finite; nothing
  /// is changed then.
  void setJoints(const JointPositions& positions, const JointPoses& poses = {});

  /// Adds an object, or replaces that of the same name. Objects are checked against all links, except that which
  /// carries them, and carried ones also against all others.
  /// @param may_touch  bodies that may touch it, as the fingers that hold it, by names or patterns.
  /// @throws std::invalid_argument, with the reason, and the scene is unchanged: the robot has no link of the name
  /// `frame`, or has one of the object's name; a name that is empty or a pattern; a pose that is not finite; no shape,
  /// or one that is not valid; a mesh that cannot be read. Cancelled.
  void addObject(const WorldObject& object, const std::vector<std::string>& may_touch = {});

  /// Moves an object to another pose in its frame. @throws std::invalid_argument if there is none of the name, or the
  /// pose is not finite.
  void moveObject(const std::string& name, const Isometry3d& X_frame_B);

  /// @throws std::invalid_argument if there is none of the name.
  void removeObject(const std::string& name);

  /// Names of the objects, in the order in which they were added.
  std::vector<std::string> objects() const;

  /// Checks a motion as a whole, also between its waypoints.
  /// @throws std::invalid_argument, with the joint and the value: fewer than two waypoints, times that do not increase,
  /// as many states as times; a joint that does not exist, or is not named in all states; values that are not finite or
  /// beyond limits; see also completePlan() and planAlong().
  MotionResult check(const RobotTrajectory& trajectory, const MotionCheckOptions& options = {}) const;

  /// Checks many motions on all cores, such as the edges of a planner's graph: coarsely first, and each only up to its
  /// first part that is not CLEAR. check() tells more of those that are not.
  /// @param options  `margin` and `allow_beyond_limits` count.
  /// @throws std::invalid_argument as check(), with the number of the motion, from 0.
  std::vector<MotionSummary> checkMotions(const std::vector<RobotTrajectory>& trajectories,
                                          const MotionCheckOptions& options = {}) const;

  /// The smallest distance of all pairs, or the deepest contact; an UNCERTAIN pair comes before one that is CLEAR and
  /// nearer. Joints may be beyond their limits [rad or m]; those that are not named are where setJoints() has them.
  ///
  /// If a pair is NOT_CHECKED and this one is CLEAR, the verdict is NOT_CHECKED with the other's reason: the distance
  /// holds for all pairs but those that distances() lists as such.
  /// @throws std::invalid_argument for a joint that does not exist or a value that is not finite.
  ///@{
  BodyDistance distance(const JointPositions& joints) const;
  BodyDistance distance(const RobotState& state) const;
  ///@}

  /// The same of all pairs that are, or may be, nearer than a range, the nearest first. Pairs that are NOT_CHECKED come
  /// before all others.
  /// @param range  [m], not negative; infinite: of all pairs. @throws std::invalid_argument otherwise.
  ///@{
  std::vector<BodyDistance> distances(const JointPositions& joints, double range) const;
  std::vector<BodyDistance> distances(const RobotState& state, double range) const;
  ///@}

 private:
  struct Impl;
  explicit RobotScene(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace sdf_ccd
