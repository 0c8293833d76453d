#pragma once

#include <memory>
#include <optional>

#include "sdf_ccd/simulation.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

/// Collision geometry in the body's frame B, whose origin is the centre of mass. Several bodies may share it.
struct CollisionShape {
  std::optional<DistanceField> field;  ///< none: the body only has a shell
  PointShell shell;                    ///< empty: the body only has a field
  SphereTree tree;
  BoundingBall ball;  ///< contains points and surface; infinite for a half-space
};

/// A shape of points only.
std::shared_ptr<const CollisionShape> makeShape(PointShell shell);

}  // namespace sdf_ccd
