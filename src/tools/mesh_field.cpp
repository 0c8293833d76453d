#include "mesh_field.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "common/time_limit.h"
#include "field/machine_limit.h"
#include "field/source_field.h"
#include "field/voxel_field.h"
#include "lost_walls.h"
#include "progress_bar.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd::tools {

OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh) {
  OrientedMesh oriented = orientOutward(mesh);
  const std::string warning = warningOf(oriented.quality);
  if (!warning.empty()) std::cerr << "sdf_ccd: " << source << ": " << warning << std::endl;
  return oriented;
}

void printSolid(const SolidReport& report, const std::string& indent) {
  const std::string found = summary(report), doubt = warning(report);
  if (!found.empty()) std::cout << indent << found << "\n";
  if (!doubt.empty()) std::cout << indent << "warning: " << doubt << "\n";
}

MeshField buildWithBar(const std::string& title, const SolidSource& source, FieldOptions options,
                       ThinWalls thin_walls) {
  constexpr double kSecondsForWalls = 10.0;
  constexpr int kMostCells = 16384;  // along the longest side, of any field
  options.max_bytes = std::min(options.max_bytes, machineLimit());
  ProgressBar bar(title);
  const auto build = [&](const FieldOptions& tried) {
    DistanceField field = buildField(source, tried, [&](double share) { bar(share); });
    const bool is_exact = source.voxels() && canBeLattice(*source.voxels(), tried);
    std::optional<LostSurface> lost;
    if (!is_exact) lost = findLostSurface(field, source.closed().solid());
    return MeshField{std::move(field), lost};
  };
  MeshField made = build(options);
  if (thin_walls == ThinWalls::kReport) return made;
  FieldOptions finer = options;
  finer.max_bytes = std::min(finer.max_bytes, kMaxFieldBytes);
  try {
    withinSeconds(kSecondsForWalls, "", [&] {
      while (made.lost && isNoticed(*made.lost) && *finer.cells <= kMostCells / 2) {
        *finer.cells *= 2;
        made = build(finer);
      }
    });
  } catch (const std::length_error&) {
  } catch (const TookTooLong&) {
  }
  return made;
}

void warnOfLost(const std::string& source, const MeshField& made) {
  const std::string text = made.lost ? describeLost(*made.lost, made.field) : "";
  if (!text.empty()) std::cerr << "sdf_ccd: " << source << ": " << text << std::endl;
}

DistanceField buildFileField(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                             const FieldOptions& options, ThinWalls thin_walls) {
  MeshField built = buildWithBar("field", {mesh, made}, options, thin_walls);
  warnOfLost(file, built);
  return std::move(built.field);
}

}  // namespace sdf_ccd::tools
