#include "mesh_pool.h"

#include <algorithm>
#include <utility>

#include "coarsen.h"
#include "common/number_text.h"
#include "element_options.h"
#include "field/build_field.h"
#include "field/field_cache.h"
#include "field/grid_cell.h"
#include "field/machine_limit.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"
#include "shell/shell_cache.h"

namespace sdf_ccd {
namespace {

constexpr int kWidestBand = 32;  // cells

}  // namespace

SharedContent& MeshPool::content() {
  static SharedContent of_process;
  return options_.is_shared ? of_process : content_;
}

PooledMesh& MeshPool::find(const GeometryDescription& geometry) {
  const TriangleMesh& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape);
  const bool voxels = geometry.watertight_voxels;
  const std::string key = keys_.keyOf(geometry);
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  PooledMesh pooled;
  pooled.voxels = voxels;
  pooled.cell_size = geometry.cell_size;
  pooled.field = geometry.field;
  if (voxels) {
    validate(mesh);
    pooled.mesh = mesh;
    pooled.made.may_be_voxels = true;
  } else {
    OrientedMesh oriented = orientOutward(mesh);
    pooled.mesh = std::move(oriented.mesh);
    pooled.quality = oriented.quality;
  }
  return meshes_.emplace(key, std::move(pooled)).first->second;
}

std::string MeshPool::tooLong() const {
  return "preparing it takes more than the " + numberText(options_.max_preparation_time) +
         " s of max_preparation_time: its meshes have too many triangles, too many that cross each other, or too fine "
         "a "
         "field or shell";
}

ShellOptions MeshPool::shellOptions(const PooledMesh& mesh, bool has_siblings) const {
  ShellOptions options = shellOptionsFor(options_, surfaceArea(mesh.mesh), Growth::kSlow);
  options.has_siblings = has_siblings;
  return options;
}

FieldOptions MeshPool::fieldOptions(const PooledMesh& mesh) const {
  FieldOptions options = withResolution(fieldOptionsFor(options_, surfaceArea(mesh.mesh)));
  if (mesh.cell_size) {
    options.cells.reset();
    options.max_error.reset();
    options.cell_size = mesh.cell_size;
  }
  double cell = 0.0;
  if (options.cells) cell = boundingBox(mesh.mesh).sizes().maxCoeff() / *options.cells;
  if (options.cell_size) cell = *options.cell_size;
  if (options.max_error) cell = *options.max_error / kHalfSqrt3;
  const ShellOptions shell = shellOptions(mesh, false);
  const double gap = !mesh.voxels && shell.edge_gap > 0.0 ? std::min(shell.edge_gap, shell.spacing) : shell.spacing;
  const double margin = 1.1 * (gap + kHalfSqrt3 * cell + options_.motion_margin);
  options.band = std::max(options.band, std::min(margin, kWidestBand * cell));
  return options;
}

MeshPool::Made MeshPool::makeField(PooledMesh& mesh, const Progress& progress) {
  if (mesh.field) return {};
  FieldOptions options = fieldOptions(mesh);
  options.max_bytes = std::min(options.max_bytes, machineLimit(field_bytes_));
  std::string warning;
  std::optional<double>& fineness = options.max_error ? options.max_error : options.cell_size;
  const auto make = [&](double tried) {
    if (fineness) fineness = tried;
    return cachedField(cache_, {mesh.mesh, mesh.made}, options, progress);
  };
  const double coarsest = fineness && !mesh.cell_size ? coarsestField(options_) : 1.0;
  CachedField made = makeCoarser(fineness.value_or(1.0), coarsest, make, warning);
  mesh.field = std::move(made.field);
  field_bytes_ += mesh.field->bytes();
  if (options.max_error && mesh.field->errorBound() > 1.001 * *options.max_error) {
    warning = "field: error " + numberText(mesh.field->errorBound()) + " m instead of " +
              numberText(*options.max_error) + " m; cells cannot be smaller";
  }
  if (!warning.empty()) made.outcome.warning = warning;
  return {true, std::move(made.outcome)};
}

MeshPool::Made MeshPool::makeShell(PooledMesh& mesh, bool has_siblings) {
  std::optional<PointShell>& shell = mesh.shells[has_siblings];
  if (shell) return {};
  ShellOptions options = shellOptions(mesh, has_siblings);
  std::string warning;
  const auto make = [&](double tried) {
    setFineness(tried, options);
    return cachedShell(cache_, {mesh.mesh, mesh.made}, options);
  };
  CachedShell made = makeCoarser(finenessOf(options), coarsestShell(options_), make, warning);
  shell = std::move(made.shell);
  if (!warning.empty()) made.outcome.warning = warning;
  return {true, std::move(made.outcome)};
}

}  // namespace sdf_ccd
