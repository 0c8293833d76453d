#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/shell/point_shell.h"
#include "sdf_ccd/shell/sphere_tree.h"

namespace sdf_ccd {

struct BodySurface;

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
  std::string failure;          ///< why it cannot be checked; empty if it can
  std::string warning;          ///< what is to be known of its meshes' inside (see warningOf()); empty if nothing
  std::vector<BodyPart> parts;  ///< empty if no pair needs its field
  PointShell shell;             ///< frame B; empty if no pair needs it. Points deep inside a sibling part are left out
  SphereTree tree;
  PointShell witnesses;  ///< frame B; instead of a shell a point of each component of the surface, but of half-spaces
  SphereTree witness_tree;
  std::shared_ptr<const BodySurface> surface;  ///< where a pair has a field with openings; null for a half-space
  BoundingBall ball;                           ///< holds the body's surface, frame B; see kHalfSpaceRadius

  /// The field of a body that is one element in the body's own frame.
  /// @throws std::logic_error if it is not.
  const DistanceField& field() const&;
  const DistanceField& field() const&& = delete;  ///< of a body that is gone before it is used
};

/// Holds the body's surface, frame B: its shell's points, else its fields' boxes. Of a half-space, what lies within
/// 10 m of the body's origin.
BoundingBall motionBall(const Body& body);

}  // namespace sdf_ccd
