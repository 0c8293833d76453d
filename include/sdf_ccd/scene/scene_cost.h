#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sdf_ccd/scene/scene.h"

namespace sdf_ccd {

/// What building a body is expected to cost. Estimates: on robots' links most are within a factor of three.
struct BodyCost {
  std::string name;
  double field_bytes = 0.0;
  double largest_field = 0.0;  ///< of the meshes' fields that are built [bytes]
  double shell_points = 0.0;
  double largest_shell = 0.0;  ///< of the elements' shells [points]
  double shell_bytes = 0.0;
  double seconds = 0.0;   ///< on the threads of the caller's TBB arena; 0 for what the cache has
  bool in_cache = false;  ///< all of its meshes' fields
};

struct SceneCost {
  std::vector<BodyCost> bodies;  ///< those of which something is built
  double bytes = 0.0;
  double seconds = 0.0;
};

/// Expects the cost of buildScene() with the same arguments, from areas, edges and errors alone; meshes of equal
/// content count once. What buildScene() would refuse costs nothing here.
SceneCost expectedCost(const SceneDescription& description, const ScenePlan& plan, const SceneOptions& options);

/// expectedCost(), where it can be meant.
/// @throws std::invalid_argument if max_error is larger than every body; std::length_error if a field or shell is
/// expected to be over three times what the options allow for one (a little more makes it coarser), or all of them
/// together more than this machine's memory. The message names max_error, the cost and the limit.
SceneCost affordableCost(const SceneDescription& description, const ScenePlan& plan, const SceneOptions& options);

/// One line: "about 9 MB and 4 s; most for link5: 2 MB, 1 s".
std::string summary(const SceneCost& cost);

}  // namespace sdf_ccd
