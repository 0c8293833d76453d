#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/common/shared_value.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/query/verdict.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

struct BodySurface;
struct BodyTriangles;
class TriangleTree;

/// One collision element with its field.
struct BodyPart {
  Isometry3d X_BG;
  DistanceField field;
};

/// Radius of the ball that represents a half-space, about the origin of its body [m]. The ball also contains everything
/// else that the body has.
constexpr double kHalfSpaceRadius = 10.0;

/// A body that is ready to be checked.
struct Body {
  std::string name;
  std::string frame;
  Isometry3d X_frame_B = Isometry3d::Identity();
  bool is_world = false;
  std::string map;                ///< the map that the body is a tile of; empty if it is none
  std::string failure;            ///< why it cannot be checked; empty if it can
  std::string warning;            ///< about the inside of its meshes (see warningOf()); empty if there is none
  std::vector<BodyPart> parts;    ///< empty if no pair needs its field
  SharedValue<PointShell> shell;  ///< frame B; empty if no pair needs it; without points deep inside a sibling part
  SharedValue<SphereTree> tree;
  SharedValue<PointShell> witnesses;  ///< frame B; replace a shell: one point per component, none for half-spaces
  SharedValue<SphereTree> witness_tree;
  std::shared_ptr<const BodySurface> surface;      ///< set if a pair has a field with openings; null for a half-space
  std::shared_ptr<const BodyTriangles> triangles;  ///< decide the pairs whose bodies both have them; null if the body
                                                   ///< is not made of triangles alone, or is in no such pair
  /// All bounded geometry of a body with a mesh whose sign is not trusted (MeshQuality::sign_trusted), with caps in
  /// openings and boxes around primitives, frame B. Only points with a free line of sight to the outside are certainly
  /// outside. Null for other bodies, whose fields give the sign.
  std::shared_ptr<const TriangleTree> doubtful;
  bool inside_is_doubtful = false;      ///< for such a body: its fields may also treat cavities as solid
  BoundingBall ball;                    ///< contains the body's surface, frame B; see kHalfSpaceRadius
  std::shared_ptr<const void> content;  ///< keeps alive data shared with other bodies

  /// The field of a body with one element, whose frame is the body frame.
  /// @throws std::logic_error if it is not.
  const DistanceField& field() const&;
  const DistanceField& field() const&& = delete;  ///< the body would be destroyed before the field is used
};

/// A ball that contains the body's surface, frame B: the points of its shell, or else the boxes of its fields. For a
/// half-space: everything within 10 m of the body's origin.
BoundingBall motionBall(const Body& body);

/// What was built for one body; a row of the plan's table.
struct BodyReport {
  std::string name;
  std::string geometry;         ///< "mesh (300 triangles, closed)", "box", …
  std::string field;            ///< "cached", "built 1.2 s", "exact", "shared", "left out"
  std::size_t field_bytes = 0;  ///< data shared by several bodies, such as a mesh, is counted for the first one
  std::size_t cells = 0;        ///< stored cells
  double field_error = 0.0;     ///< [m]
  std::size_t shell_points = 0;
  std::size_t shell_bytes = 0;
  std::size_t witnesses = 0;  ///< Body::witnesses
  double gap = 0.0;           ///< between its shell's points, for a pair of equal shells [m]
  std::size_t pairs = 0;
  ErrorBound bound;   ///< of verdicts, largest over its pairs; chord: as the options allow
  std::string solid;  ///< parts of its meshes that were left out as inside their solids; empty if none, or cached
  bool is_cache_incomplete = false;  ///< a field or shell was made for the cache but is not in it; a warning says why
  std::vector<std::string> warnings;
};

}  // namespace sdf_ccd
