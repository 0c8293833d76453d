#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "field/field_cost.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

class MeshPool;

/// What building a body is expected to cost.
struct BodyCost {
  std::string name;
  double field_bytes = 0.0;
  double largest_field = 0.0;  ///< of the meshes' fields that are built [bytes]
  double shell_points = 0.0;
  double largest_shell = 0.0;  ///< of the elements' shells [points]
  double shell_bytes = 0.0;
  double seconds = 0.0;        ///< on the threads of the caller's TBB arena; 0 for what the cache has
  double field_seconds = 0.0;  ///< of these, for fields
  bool uncertain = false;      ///< a field may take more than twice, or less than half, of what is expected
  bool in_cache = false;       ///< all of its meshes' fields

  /// A field that is built, and a shell of so many points.
  void addField(const FieldCost& field);
  void addShell(double points);
};

struct SceneCost {
  std::vector<BodyCost> bodies;  ///< those of which something is built
  double bytes = 0.0;
  double seconds = 0.0;
  std::shared_ptr<MeshPool> meshes;  ///< made ready, for the first buildScene() that has them

  void add(const BodyCost& body);
};

/// Per body: whether a verdict rests on its shell, as a pair's other body has no triangles to decide by.
std::vector<char> shellsThatDecide(const SceneDescription& description, const ScenePlan& plan);

/// Expects the cost of buildScene() with the same arguments: of fields by building a sample of their cells (see the
/// fields' expectedCost()), of shells from areas and edges. Meshes of equal content count once. What buildScene() would
/// refuse costs nothing here.
SceneCost expectedCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options);

/// @throws std::length_error if a field or shell is expected to be over twice what the options allow for one (a little
/// more makes it coarser), where these have a max_error, or all of them together more than this machine's memory. The
/// message names max_error, the cost and the limit.
void requireAffordable(const SceneCost& cost, const BodyOptions& options);

/// expectedCost(), where it can be meant.
/// @throws std::invalid_argument if max_error is larger than every body; as requireAffordable().
SceneCost affordableCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options);

/// One line: "about 9 MB and 4 s; most for link5: 2 MB, 1 s".
std::string summary(const SceneCost& cost);

}  // namespace sdf_ccd
