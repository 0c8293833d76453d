#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/mesh/mesh_quality.h"
#include "sdf_ccd/mesh/primitive.h"
#include "sdf_ccd/mesh/triangle_mesh.h"

namespace sdf_ccd {

/// One collision element: a primitive, or a mesh as loaded and scaled.
struct GeometryDescription {
  std::variant<Primitive, std::shared_ptr<const TriangleMesh>> shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< its frame G in the body's frame B
  std::string source;                        ///< for display: "box" or the mesh's URI
  bool watertight_voxels = false;            ///< boundary of whole voxels: has no shell
  std::optional<double> cell_size = {};      ///< of a mesh's field [m]; none: that of BodyOptions::field
  std::optional<Vector3d> scale = {};        ///< of the mesh in the file `source`; none if that file has another name
  /// Of the mesh, made elsewhere (a map's tile), as accurate as the options require; none: it is built.
  std::optional<DistanceField> field = {};
};

/// Whether the element is a half-space, which is unbounded.
inline bool isHalfSpace(const GeometryDescription& geometry) {
  const auto* primitive = std::get_if<Primitive>(&geometry.shape);
  return primitive && isHalfSpace(*primitive);
}

/// Whether a body's field and shell are made, as far as its pairs need them: without, these have verdicts, distances
/// and depths, but no forces.
enum class Forces {
  kKnown,     ///< they are made
  kAwaited,   ///< they are made later
  kUnwanted,  ///< they are not made
  kFailed,    ///< they could not be made
};

/// Why there are none, such as "its field and shell are being built"; empty if they are known.
const char* whyNoForces(Forces forces);

/// What is to know of a body besides its geometry. Bodies of equal geometry differ in nothing else.
struct BodyPlace {
  std::string name;
  std::string frame;                              ///< the tf frame that carries it
  Isometry3d X_frame_B = Isometry3d::Identity();  ///< its frame B in that frame
  std::string failure;                            ///< why the body cannot be checked; empty if it can
  bool is_world = false;                          ///< an object of the world, not a link
  std::string map;                                ///< the map that the body is a tile of; empty if it is none
  Forces forces = Forces::kKnown;
};

/// Whether all is equal, poses to the last bit.
inline bool operator==(const BodyPlace& a, const BodyPlace& b) {
  return a.name == b.name && a.frame == b.frame && a.X_frame_B.matrix() == b.X_frame_B.matrix() &&
         a.failure == b.failure && a.is_world == b.is_world && a.map == b.map && a.forces == b.forces;
}

/// A rigid body: a robot's link or an object of the world.
struct BodyDescription : BodyPlace {
  std::vector<GeometryDescription> geometry;

  bool is_attached = false;  ///< an object that a link carries: it is also checked against objects of the world at rest

  /// The first of the links that only fixed joints join to the body's frame, and the frame in it. Bodies of the same
  /// one do not move relative to each other. Empty if no such link is known. See setRigidRoots().
  std::string rigid_root;
  Isometry3d X_root_frame = Isometry3d::Identity();
};

/// Why a pair is not checked. Of several reasons, the first of these counts.
enum class PairKind {
  kRequest,     ///< a rule of update_scene
  kTouchLinks,  ///< attached, and allowed by its touch_links
  kUser,        ///< the parameter allowed_pairs, or a caller of the library
  kSrdf,
  kRigid,       ///< rigidly joined, or in the same frame
  kAdjacent,    ///< joined by one movable joint
  kEmpty,       ///< one of them has no geometry
  kNever,       ///< learned: they are apart in all states
  kAlways,      ///< they overlap at rest, and overlap, or as neighbours touch, in all other states
  kHeld,        ///< the same, but at rest they touch as neighbours
  kAtRest,      ///< they overlap at rest
  kHeldAtRest,  ///< at rest they touch as neighbours
  kMayAtRest    ///< they may overlap at rest
};

/// How two bodies are that do not move relative to each other.
struct RigidPose {
  Isometry3d X_AB;
  BoundingBall ball_a, ball_b;  ///< contain their geometry, each in its body's frame; infinite for half-spaces
};

/// A decision about a pair: it is left out of a scene, and why.
struct PairDecision {
  std::string body_a, body_b;  ///< names
  std::string text = {};       ///< for people: "SRDF: Adjacent", "adjacent", …
  PairKind kind = PairKind::kUser;
  double depth = 0.0;                           ///< if they overlap at rest: of the deepest point found there [m]
  std::shared_ptr<const RigidPose> rigid = {};  ///< of kRigid
  int a = -1, b = -1;                           ///< the bodies of a planned scene, by index
};

/// A pair that a scene leaves out although it needs a check.
struct UncheckedPair {
  int body_a = -1, body_b = -1;  ///< in SceneDescription::bodies
  std::string reason;
};

/// Bodies, and the pairs of them that need no check.
struct SceneDescription {
  std::vector<BodyDescription> bodies;  ///< names are unique
  std::vector<PairDecision> allowed;    ///< the allowed collision matrix: these pairs may collide and are not checked
  std::vector<std::string> visual_only = {};  ///< links without body: they have a visual, but no collision shape
  /// Tiles of a live map are part of the scene, or may be of one that follows. What links and attached objects fill of
  /// the map is known by their fields and surfaces, which are kept even if no pair needs them.
  bool has_live_map = false;
};

}  // namespace sdf_ccd
