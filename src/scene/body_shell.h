#pragma once

#include <vector>

#include "sdf_ccd/body.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

/// A part's shell, and its field if that gives a reliable sign.
struct ShellPart {
  Isometry3d X_BG;
  PointShell shell;            ///< frame G
  const DistanceField* field;  ///< frame G; null if it is not known or not trusted
};

/// The shell of all parts together, frame B, without the points deep inside other parts (see buildUnshared()).
///
/// contactGap() holds for it, also where parts overlap and their surfaces meet in seams that are no edges of theirs:
/// take an extreme point x of the convex hull of the intersection of bodies A and B. A part with x inside, or on a flat
/// piece, contains a plane through x nearby, and two planes share a line through x, of which no extreme point is the
/// middle. So x lies on an edge of every part of A that it touches and inside none, or the same holds for B; as x is
/// inside no sibling, the point near it on that edge is kept.
PointShell unionShell(const std::vector<ShellPart>& parts);

/// Of a shell and its tree.
std::size_t bytesOf(const PointShell& shell, const SphereTree& tree);

/// A small ball around all points of a shell.
BoundingBall boundingBall(const PointShell& shell);

}  // namespace sdf_ccd
