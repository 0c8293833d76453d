#pragma once

#include <vector>

#include "sdf_ccd/scene/scene.h"

namespace sdf_ccd {

/// A part's shell, and its field if it may be asked what lies inside it.
struct ShellPart {
  Isometry3d X_BG;
  PointShell shell;            ///< frame G
  const DistanceField* field;  ///< frame G; null if it is not known or not trusted
};

/// The shell of all parts together, frame B, without the points deep inside other parts (see buildScene()).
PointShell unionShell(const std::vector<ShellPart>& parts);

/// A small ball around all points of a shell.
BoundingBall boundingBall(const PointShell& shell);

}  // namespace sdf_ccd
