#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

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

/// What is to know of a body besides its geometry. Bodies of equal geometry differ in nothing else.
struct BodyPlace {
  std::string name;
  std::string frame;                              ///< the tf frame that carries it
  Isometry3d X_frame_B = Isometry3d::Identity();  ///< its frame B in that frame
  std::string failure;                            ///< why the body cannot be checked; empty if it can
  bool is_world = false;                          ///< an object of the world, not a link
  std::string map;                                ///< the map that the body is a tile of; empty if it is none
};

/// Whether all is equal, poses to the last bit.
inline bool operator==(const BodyPlace& a, const BodyPlace& b) {
  return a.name == b.name && a.frame == b.frame && a.X_frame_B.matrix() == b.X_frame_B.matrix() &&
         a.failure == b.failure && a.is_world == b.is_world && a.map == b.map;
}

/// A rigid body: a robot's link or an object of the world.
struct BodyDescription : BodyPlace {
  std::vector<GeometryDescription> geometry;
};

/// A joint that slides, and the range of positions that is assumed of it [m].
struct SlideRange {
  std::string joint;
  double low;
  double high;
};

/// Why two bodies can never meet, or never move relative to each other, as a robot's joints move them.
struct PairProof {
  BoundingBall ball_a, ball_b;       ///< contain the geometry, in the body's frame; infinite for half-spaces
  std::vector<SlideRange> slides;    ///< prismatic joints between them, which must stay in their ranges
  std::optional<Isometry3d> X_AB;    ///< of a pair that is rigidly joined; it has no slides
};

/// A pair that is allowed to collide, so it is left out, by the bodies' names.
struct AllowedPair {
  std::string body_a;
  std::string body_b;
  std::string reason;   ///< "SRDF: Adjacent", "rigidly joined", …
  bool proved = false;  ///< their bodies can never meet: rigidly joined, or out of reach
  double depth = 0.0;   ///< if they overlap at rest: of the deepest point found there [m]
  std::shared_ptr<const PairProof> proof = {};  ///< of a proved pair; null: nobody can tell whether it holds
};

/// A pair that a scene leaves out although it needs a check.
struct UncheckedPair {
  int body_a = -1, body_b = -1;  ///< in SceneDescription::bodies
  std::string reason;
};

/// Bodies, and the pairs of them that need no check.
struct SceneDescription {
  std::vector<BodyDescription> bodies;  ///< names are unique
  std::vector<AllowedPair> allowed;     ///< the allowed collision matrix: these pairs may collide and are not checked
  std::vector<std::string> visual_only = {};  ///< links without body: they have a visual, but no collision shape
  /// Tiles of a live map are part of the scene, or may be of one that follows. What links and attached objects fill of
  /// the map is known by their fields and surfaces, which are kept even if no pair needs them.
  bool has_live_map = false;
};

}  // namespace sdf_ccd
