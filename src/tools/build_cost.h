#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/mesh_pool.h"
#include "monitor/scene_cost.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd::tools {

/// Point spacing [m] of a shell whose field has this error bound [m]: two cells of a uniform grid.
inline double shellSpacing(double error_bound) {
  return 2.3 * error_bound;
}

/// Expected cost of building fields and shells. Checked against the same limits, and reported in the same form, as by
/// the monitor and check-bag.
class BuildCost {
 public:
  /// @param spacing  of the shells' points [m]; if not set, shellSpacing() of the field's error bound.
  explicit BuildCost(std::optional<double> spacing) : spacing_(spacing) {}

  /// Adds the field of a mesh, and its shell if it is not of voxels. A mesh that cannot be built adds no cost. It must
  /// outlive this object.
  void add(const std::string& name, PooledMesh& mesh, const FieldOptions& options);

  /// Adds a field alone.
  void addField(const std::string& name, const TriangleMesh& mesh, MadeSolid& made, const FieldOptions& options);

  const SceneCost& cost() const { return cost_; }

  /// @throws std::length_error as requireAffordable() for scenes; the message names an option that would fit.
  void requireAffordable() const;

  /// requireAffordable(), and prints the expected cost if building takes more than a second.
  void announce() const;

 private:
  struct Wanted {
    std::string name;
    const TriangleMesh* mesh;
    MadeSolid* made;
    bool has_shell;
    FieldOptions options;
  };

  void add(const Wanted& wanted);

  BodyCost expected(const Wanted& wanted) const;
  /// The resolution option, coarsened by a power of two, that is affordable; empty if 1024 times coarser is not.
  std::string whatFits() const;

  std::optional<double> spacing_;
  std::vector<Wanted> wanted_;
  SceneCost cost_;
};

}  // namespace sdf_ccd::tools
