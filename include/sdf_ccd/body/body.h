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

/// Of a half-space, what lies within this of its body's origin is taken for its ball, which holds all else that the
/// body has [m].
constexpr double kHalfSpaceRadius = 10.0;

/// A body that is ready to be checked.
struct Body {
  std::string name;
  std::string frame;
  Isometry3d X_frame_B = Isometry3d::Identity();
  bool is_world = false;
  std::string failure;            ///< why it cannot be checked; empty if it can
  std::string warning;            ///< what is to be known of its meshes' inside (see warningOf()); empty if nothing
  std::vector<BodyPart> parts;    ///< empty if no pair needs its field
  SharedValue<PointShell> shell;  ///< frame B; empty if no pair needs it; without points deep inside a sibling part
  SharedValue<SphereTree> tree;
  SharedValue<PointShell> witnesses;  ///< frame B; instead of a shell a point of each component, but of half-spaces
  SharedValue<SphereTree> witness_tree;
  std::shared_ptr<const BodySurface> surface;      ///< where a pair has a field with openings; null for a half-space
  std::shared_ptr<const BodyTriangles> triangles;  ///< what decides about it and another one that has them; null of a
                                                   ///< body that is not all triangles, or in no such pair
  /// All bounded geometry of a body that has a mesh of which it is doubtful what is inside (MeshQuality::doubtful),
  /// with caps in openings and boxes around primitives, frame B: only what sees the outside past it is surely outside.
  /// Null of other bodies, whose fields know.
  std::shared_ptr<const TriangleTree> doubtful;
  BoundingBall ball;                    ///< holds the body's surface, frame B; see kHalfSpaceRadius
  std::shared_ptr<const void> content;  ///< keeps what other bodies of this process find (BodyOptions::is_shared)

  /// The field of a body that is one element in the body's own frame.
  /// @throws std::logic_error if it is not.
  const DistanceField& field() const&;
  const DistanceField& field() const&& = delete;  ///< of a body that is gone before it is used
};

/// Holds the body's surface, frame B: its shell's points, else its fields' boxes. Of a half-space, what lies within
/// 10 m of the body's origin.
BoundingBall motionBall(const Body& body);

/// What was built for one body; a row of the plan's table.
struct BodyReport {
  std::string name;
  std::string geometry;         ///< "mesh (300 triangles, closed)", "box", …
  std::string field;            ///< "cached", "built 1.2 s", "exact", "shared", "left out"
  std::size_t field_bytes = 0;  ///< a mesh that several bodies have counts for the first
  std::size_t cells = 0;        ///< stored cells
  double field_error = 0.0;     ///< [m]
  std::size_t shell_points = 0;
  std::size_t shell_bytes = 0;
  std::size_t witnesses = 0;  ///< Body::witnesses
  double gap = 0.0;           ///< between its shell's points, against a body with a like shell [m]
  std::size_t pairs = 0;
  ErrorBound bound;   ///< of verdicts, the largest of its pairs; chord: what the options allow for
  std::string solid;  ///< what of its meshes lies inside their solids and was left out; empty if nothing, or cached
  std::vector<std::string> warnings;
};

}  // namespace sdf_ccd
