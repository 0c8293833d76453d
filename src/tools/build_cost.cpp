#include "build_cost.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "common/number_text.h"
#include "field/grid_cell.h"
#include "geometry/unit_hint.h"
#include "monitor/plan/scene_cost.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::tools {
namespace {

FieldOptions coarser(FieldOptions options, int times) {
  if (options.max_error) *options.max_error *= times;
  if (options.cell_size) *options.cell_size *= times;
  if (options.cells) *options.cells = std::max(1, *options.cells / times);
  return options;
}

/// The resolution as a command line option.
std::string asOption(const FieldOptions& options) {
  if (options.max_error) return "--max-error " + shortText(*options.max_error);
  if (options.cell_size) return "--cell " + shortText(*options.cell_size);
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

double errorOf(const FieldOptions& options, const TriangleMesh& mesh) {
  if (options.max_error) return *options.max_error;
  if (options.cell_size) return kHalfSqrt3 * *options.cell_size;
  return kHalfSqrt3 * boundingBox(mesh).sizes().maxCoeff() / *options.cells;
}

void announceCost(const std::string& name, const TriangleMesh& mesh, const SolidSource& source,
                  const FieldOptions& field, const ShellOf& shell) {
  constexpr double kReported = 1.0;  // [s]
  constexpr int kCoarsest = 1024;    // times coarser
  const auto affordable = [&](const FieldOptions& options) {
    BodyCost body;
    body.name = name;
    body.hint = unitHint(mesh);
    body.addField(expectedCost(source, options));
    if (shell) body.addShell(expectedPoints(mesh, shell(errorOf(options, mesh))));
    SceneCost cost;
    cost.add(body);
    requireAffordable(cost, limits(field));
    return cost;
  };
  const auto whatFits = [&]() -> std::string {
    for (int times = 2; times <= kCoarsest; times *= 2) {
      try {
        affordable(coarser(field, times));
        return "; " + asOption(coarser(field, times)) + " would fit";
      } catch (const std::length_error&) {
        continue;
      }
    }
    return "";
  };
  try {
    const SceneCost cost = affordable(field);
    if (cost.seconds > kReported) std::cout << "expected " << summary(cost) << std::endl;
  } catch (const std::length_error& refused) {
    throw std::length_error(refused.what() + whatFits());
  }
}

}  // namespace sdf_ccd::tools
