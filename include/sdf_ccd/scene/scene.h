#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/field/field_options.h"
#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/query/verdict.h"
#include "sdf_ccd/scene/body_surface.h"
#include "sdf_ccd/scene/scene_description.h"
#include "sdf_ccd/scene/scene_plan.h"
#include "sdf_ccd/shell/sample_surface.h"
#include "sdf_ccd/shell/sphere_tree.h"

namespace sdf_ccd {

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
  Isometry3d X_frame_B;
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
};

/// The fields' bands are widened, before anything is built, to 1.1 × (shell.spacing, or edge_gap if there is
/// one, + the field's own error + motion_margin), so that they hold the margin at which a pair ceases to be CLEAR; at
/// most to 32 cells, beyond which the bounds that every field has anywhere are fine enough.
struct SceneOptions {
  FieldOptions field;
  ShellOptions shell;
  double motion_margin = 1e-3;  ///< chord tolerance and motion errors to allow for in the bands [m]
  std::string cache_directory;  ///< empty: nothing is read or written

  /// The bound that field, shell and motion_margin are shares of (see error_budget.h) [m]. If it is set, a field or
  /// shell that would be too large is made coarser, and its body's report says so; else the body cannot be checked.
  std::optional<double> max_error;
};

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
  ErrorBound bound;   ///< the largest of its pairs; chord: what the options allow for
  std::string solid;  ///< what of its meshes lies inside their solids and was left out; empty if nothing, or cached
  std::vector<std::string> warnings;
};

struct Scene {
  std::vector<Body> bodies;
  std::vector<PlannedPair> pairs;
  std::vector<LeftOut> left_out;
  std::vector<std::string> visual_only;  ///< as in SceneDescription: nothing is known of where they are solid
  std::vector<BodyReport> reports;
  ErrorBound bound;                 ///< the largest of all pairs; chord: what the options allow for
  std::optional<double> max_error;  ///< that was wanted [m]
  double build_seconds = 0.0;
};

/// What planScene() has to know of the options.
inline PlanOptions planOptions(const SceneOptions& options) {
  PlanOptions plan;
  plan.shell_spacing = options.shell.spacing;
  plan.edge_gap = options.shell.edge_gap < options.shell.spacing ? options.shell.edge_gap : 0.0;
  return plan;
}

/// Builds, or takes from the cache, what the plan needs; meshes of equal content once. A body whose field or shell
/// cannot be built keeps its place with Body::failure set; the others are not touched by it.
///
/// Shell points deeper inside a sibling part than the covering radius are left out. The radius stays true for the
/// union: a place q of its surface is outside the sibling, so (distances being 1-Lipschitz) the point nearest to q is
/// no deeper in it than the radius, and kept. Kept points inside a sibling stand for no area. Siblings that are meshes
/// count only where the plan has their field built and their sign is trusted.
/// @param progress  called with the body's name and the share of all bodies done.
Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const SceneOptions& options,
                 const std::function<void(const std::string&, double)>& progress = {});

/// The plan as one table for the log: body, geometry, field, shell, cells, bytes, error bound by source, pairs; below
/// it what failed, what to know, and what was left out, by reason.
std::string planTable(const Scene& scene);

}  // namespace sdf_ccd
