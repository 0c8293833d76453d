#include "build_cost.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "field/source_field.h"
#include "field/uniform/sparse_grid.h"
#include "print.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::tools {
namespace {

double errorOf(const FieldOptions& options, const TriangleMesh& mesh) {
  if (options.max_error) return *options.max_error;
  if (options.cell_size) return kHalfSqrt3 * *options.cell_size;
  return kHalfSqrt3 * boundingBox(mesh).sizes().maxCoeff() / *options.cells;
}

FieldOptions coarser(FieldOptions options, int times) {
  if (options.max_error) *options.max_error *= times;
  if (options.cell_size) *options.cell_size *= times;
  if (options.cells) *options.cells = std::max(1, *options.cells / times);
  return options;
}

/// The resolution as a command line option.
std::string asOption(const FieldOptions& options) {
  if (options.max_error) return "--max-error " + shortly(*options.max_error);
  if (options.cell_size) return "--cell " + shortly(*options.cell_size);
  return "--resolution " + std::to_string(*options.cells);
}

/// Body options with these field options, for the check against the cost limits.
BodyOptions limits(const FieldOptions& field) {
  BodyOptions options;
  options.field = field;
  options.max_error = field.max_error;
  options.divides_max_error = field.max_error.has_value();
  return options;
}

}  // namespace

BodyCost BuildCost::expected(const Wanted& wanted) const {
  const TriangleMesh& mesh = *wanted.mesh;
  BodyCost cost;
  cost.name = wanted.name;
  cost.addField(sdf_ccd::expectedCost(SolidSource(mesh, *wanted.made), wanted.options));
  ShellOptions shell;
  shell.spacing = spacing_.value_or(shellSpacing(errorOf(wanted.options, mesh)));
  if (wanted.has_shell) cost.addShell(expectedPoints(mesh, shell));
  return cost;
}

void BuildCost::add(const Wanted& wanted) {
  try {
    cost_.add(expected(wanted));
    wanted_.push_back(wanted);
  } catch (const std::exception&) {
    // Building it will report the error.
  }
}

void BuildCost::add(const std::string& name, PooledMesh& mesh, const FieldOptions& options) {
  add({name, &mesh.mesh, &mesh.made, !mesh.voxels, options});
}

void BuildCost::addField(const std::string& name, const TriangleMesh& mesh, MadeSolid& made,
                         const FieldOptions& options) {
  add({name, &mesh, &made, false, options});
}

std::string BuildCost::whatFits() const {
  constexpr int kMax = 1024;
  for (int times = 2; times <= kMax; times *= 2) {
    SceneCost cost;
    try {
      for (Wanted wanted : wanted_) {
        wanted.options = coarser(wanted.options, times);
        cost.add(expected(wanted));
      }
      sdf_ccd::requireAffordable(cost, limits(wanted_.front().options));
      return asOption(coarser(wanted_.front().options, times));
    } catch (const std::length_error&) {
      continue;
    }
  }
  return "";
}

void BuildCost::requireAffordable() const {
  if (wanted_.empty()) return;
  try {
    sdf_ccd::requireAffordable(cost_, limits(wanted_.front().options));
  } catch (const std::length_error& refused) {
    const std::string fits = whatFits();
    throw std::length_error(refused.what() + (fits.empty() ? "" : "; " + fits + " would fit"));
  }
}

void BuildCost::announce() const {
  constexpr double kReported = 1.0;  // [s]
  requireAffordable();
  if (cost_.seconds > kReported) std::cout << "expected " << summary(cost_) << std::endl;
}

}  // namespace sdf_ccd::tools
