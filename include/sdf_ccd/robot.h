#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <urdf_model/model.h>

#include "sdf_ccd/body.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

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

/// A file, as a ResourceLoader returns it.
struct Resource {
  std::string bytes;
  std::string name;     ///< its extension gives the format
  std::string warning;  ///< e.g. "found link.STL, the URDF says link.stl"; empty if there is none
};

/// Loads the file at a URI; throws std::runtime_error, with the URI and the reason, if it cannot.
using ResourceLoader = std::function<Resource(const std::string& uri)>;

/// Directory of a ROS package, empty if there is none.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// Searches below the directories of ROS_PACKAGE_PATH, as rospack does, for package.xml (its `name` counts, not the
/// folder's) and manifest.xml; not below a package, a hidden folder, `rospack_nosubdirs` or CATKIN_IGNORE (also
/// AMENT_IGNORE, COLCON_IGNORE). The first of equal names wins. Searches at the first call and caches the result; can
/// be called from several threads.
PackageFinder packagesFromEnvironment();

/// Reads `file://`, `package://` (also with a third slash) and plain paths (relative to `base_directory`, and to the
/// working directory if that is empty). A file or folder whose name differs only by case is used, with a warning.
/// @throws std::runtime_error, with the URI and the reason: no such package or file, a directory, not readable, another
/// scheme, `..` in a package URI.
Resource loadLocalResource(const std::string& uri, const PackageFinder& packages, const std::string& base_directory);

/// The parts of an SRDF file that are used. Names are not compared with any robot here.
struct Srdf {
  std::string robot;                                         ///< the robot's name in the file; may be empty
  std::vector<PairDecision> disabled;                        ///< text: "SRDF: " and the file's reason
  std::vector<std::string> disabled_by_default;              ///< links that are only checked against those of `enabled`
  std::map<std::string, std::string> virtual_joints;         ///< child link by name; parent frame and type are not used
  std::vector<std::pair<std::string, std::string>> enabled;  ///< overrides disabled_by_default, and adjacency
  std::vector<std::string> warnings;                         ///< what the text lacks that an SRDF should have
};

/// Reads `disable_collisions`, `disable_default_collisions`, `enable_collisions` and `virtual_joint`. As in MoveIt, a
/// pair that is both disabled and enabled is disabled. Beyond MoveIt, links of the first three may be named by
/// patterns (* for any text, ? for any character). Elements without names are ignored, or enable all: Srdf::warnings.
/// @param source  where the text is from, for errors; may be empty.
/// @throws std::runtime_error, with source, line and reason, if the text is no SRDF.
Srdf parseSrdf(const std::string& xml, const std::string& source = {});

/// Which pairs of links are checked.
struct RobotPairOptions {
  bool check_adjacent = false;  ///< also check links that a movable joint connects
};

/// The bodies of a robot: one per link with collision elements, with the name and the frame of the link. Every mesh is
/// read once and scaled; links that use it with the same scale share it.
///
/// A bad or missing mesh, or a collision element that cannot be read, only affects its link: BodyDescription::failure
/// says "link forearm: package://…: no such package", and its geometry is empty. Pairs may touch that are disabled by
/// the SRDF, or adjacent (unless requested, or enabled by the SRDF by name). planScene() leaves out others that are
/// rigidly joined, as setRigidRoots() finds them.
/// @param warnings  further notes for the user, one per line: files found with another spelling, an SRDF with another
/// robot's name or with links that the robot does not have; RobotModel::warnings(), Srdf::warnings. Failures are not
/// repeated here.
/// @throws std::length_error if the links are more than 300,000 pairs; Cancelled.
SceneDescription describeRobot(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                               const RobotPairOptions& options, std::vector<std::string>& warnings);

/// Sets BodyDescription::rigid_root of bodies in links' frames; of objects of the world only if the link is rigidly
/// joined to the robot's root. Call it again after bodies were added to `scene`.
/// @param prefix  of the frames of links, where these are not the links' names.
void setRigidRoots(const RobotModel& robot, SceneDescription& scene, const std::string& prefix = {});

/// A mesh in a file.
struct MeshObject {
  std::string uri;                    ///< as loadLocalResource() reads it
  Vector3d scale = Vector3d::Ones();  ///< along the file's axes; none of them 0
};

/// The occupied voxels of an OctoMap in a file, as parseOctomapSurface() reads it; the only shape of its object.
struct OctomapObject {
  std::string uri;         ///< as loadLocalResource() reads it
  double cell_size = 0.0;  ///< of its field [m]; 0: half a voxel
};

/// One shape of an object.
struct WorldShape {
  /// A mesh may also be one in memory.
  using Shape = std::variant<Primitive, MeshObject, OctomapObject, std::shared_ptr<const TriangleMesh>>;
  Shape shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< in the object's frame B
};

/// An object that a robot may hit, or carries.
struct WorldObject {
  std::string name;
  std::string frame;  ///< that carries it; empty: it does not move in the world
  Isometry3d X_frame_B = Isometry3d::Identity();
  std::vector<WorldShape> shapes;  ///< one or more
};

}  // namespace sdf_ccd
