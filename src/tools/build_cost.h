#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/mesh_pool.h"
#include "monitor/scene_cost.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd::tools {

/// Point spacing of a shell whose field has this error bound: two cells of a uniform grid [m].
inline double shellSpacing(double error_bound) {
  return 2.3 * error_bound;
}

/// Expected cost of building fields and shells, in the words of the monitor and check-bag.
class BuildCost {
 public:
  /// @param spacing  of the shells [m]; none: from the field's error.
  explicit BuildCost(std::optional<double> spacing) : spacing_(spacing) {}

  /// Input that cannot be built costs nothing here. The mesh must outlive this.
  void add(const std::string& name, PooledMesh& mesh, const FieldOptions& options);

  const SceneCost& cost() const { return cost_; }

  /// @throws as requireAffordable() for scenes, with the option that would fit.
  void requireAffordable() const;

 private:
  struct Wanted {
    std::string name;
    PooledMesh* mesh;
    FieldOptions options;
  };

  BodyCost expected(const Wanted& wanted) const;
  /// The option that makes it coarse enough to be affordable; empty if that is much coarser.
  std::string whatFits() const;

  std::optional<double> spacing_;
  std::vector<Wanted> wanted_;
  SceneCost cost_;
};

}  // namespace sdf_ccd::tools
