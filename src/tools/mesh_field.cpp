#include "mesh_field.h"

#include <iostream>

#include "build_cost.h"
#include "field/source_field.h"
#include "progress_bar.h"

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

DistanceField buildWithBar(const std::string& title, const SolidSource& source, const FieldOptions& options) {
  ProgressBar bar(title);
  return buildField(source, options, [&](double share) { bar(share); });
}

DistanceField buildAffordable(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                              const FieldOptions& options) {
  const SolidSource source(mesh, made);
  announceCost(file, mesh, source, options);
  return buildWithBar("field", source, options);
}

}  // namespace sdf_ccd::tools
