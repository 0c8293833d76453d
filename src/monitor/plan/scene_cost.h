#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "field/field_cost.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

class MeshPool;

/// Expected cost of building a body.
struct BodyCost {
  std::string name;
  double field_bytes = 0.0;
  double largest_field = 0.0;  ///< of the fields to be built, one per mesh [bytes]
  double shell_points = 0.0;
  double largest_shell = 0.0;  ///< of the shells, one per element [points]
  double shell_bytes = 0.0;    ///< with triangles for verdicts
  double seconds = 0.0;        ///< on the threads of the caller's TBB arena; 0 for cached data
  double field_seconds = 0.0;  ///< the part of `seconds` for fields
  bool uncertain = false;      ///< a field may differ from its estimate by more than a factor of two
  std::string hint;            ///< at a mistake that makes it cost so much, see unitHint(); empty if there is none
  bool in_cache = false;       ///< the fields of all of its meshes are cached

  /// Adds the cost of a field to be built, of a shell with that many points, and of that many triangles for verdicts.
  void addField(const FieldCost& field);
  void addShell(double points);
  void addTriangles(double count);
};

struct SceneCost {
  std::vector<BodyCost> bodies;  ///< those for which something is built
  double bytes = 0.0;
  double seconds = 0.0;
  std::shared_ptr<MeshPool> meshes;  ///< prepared; the first buildScene() that gets them uses them

  void add(const BodyCost& body);
};

/// Estimates the cost of buildScene() with the same arguments: of fields by building a sample of their cells (see
/// expectedCost() of a field), of shells from areas and edges. Meshes of equal content count once. Bodies that
/// buildScene() would refuse cost nothing.
SceneCost expectedCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options);

/// @throws std::length_error if a field or shell is expected to exceed twice its limit in the options, for options that
/// share out a max_error (a smaller excess makes it coarser), or the total exceeds this machine's memory. The message
/// names max_error, the cost and the limit.
void requireAffordable(const SceneCost& cost, const BodyOptions& options);

/// expectedCost() of a scene that can be built.
/// @throws std::invalid_argument if max_error is larger than every body; std::length_error as requireAffordable().
SceneCost affordableCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options);

/// Plan of the scene, and the expected cost of building it. @throws as affordableCost().
ScenePlan affordablePlan(const SceneDescription& description, const BodyOptions& options);

/// One line: "about 9 MB and 4 s to build; most for link5: about 2 MB and 1 s".
std::string summary(const SceneCost& cost);

}  // namespace sdf_ccd
