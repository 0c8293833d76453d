#include "sdf_ccd/field.h"

#include <algorithm>

#include "field/adaptive/build_adaptive.h"
#include "field/build_field.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "field/uniform/build_uniform.h"
#include "solid/closed_solid.h"

namespace sdf_ccd {
namespace {

/// Caps whose points are at most this share of the error bound from the mesh are not stored: they close cracks. The
/// error bounds of the field include that distance.
constexpr double kNarrowCap = 0.25;

/// The caps that a field stores: those that reach farther than `limit` [m] from the mesh. Null if none do.
/// @param narrow  is set to the largest reach of the others [m].
std::shared_ptr<const OpeningCaps> wideCaps(const Openings& openings, double limit, double& narrow) {
  TriangleMesh caps;
  std::vector<double> reach;
  narrow = 0.0;
  for (std::size_t i = 0; i < openings.reach.size(); ++i) {
    if (openings.reach[i] <= limit) {
      narrow = std::max(narrow, openings.reach[i]);
      continue;
    }
    for (int k = 0; k < 3; ++k) caps.vertices.push_back(openings.caps.vertices[openings.caps.triangles[i][k]]);
    const int last = static_cast<int>(caps.vertices.size());
    caps.triangles.emplace_back(last - 3, last - 2, last - 1);
    reach.push_back(openings.reach[i]);
  }
  if (reach.empty()) return nullptr;
  return std::make_shared<const OpeningCaps>(std::move(caps), std::move(reach));
}

}  // namespace

DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress) {
  validate(mesh);
  validate(options);
  return buildField(ClosedSolid(std::make_shared<const Solid>(mesh)), options, progress);
}

DistanceField buildField(const ClosedSolid& closed, const FieldOptions& given, const Progress& progress) {
  const FieldOptions options = withResolution(given);
  double narrow = 0.0;
  if (options.max_error) {
    const double wanted = *options.max_error;
    std::shared_ptr<const OpeningCaps> caps = wideCaps(closed.openings(), kNarrowCap * wanted, narrow);
    const double moved = closed.moved() + narrow;
    FieldOptions rest = options;
    rest.max_error = std::max(wanted - moved, 0.5 * wanted);
    return FieldAccess::make(buildAdaptive(closed.solid(), rest, progress), std::move(caps), moved);
  }
  std::shared_ptr<const SparseGrid> grid = buildUniform(closed.solid(), options, progress);
  std::shared_ptr<const OpeningCaps> caps = wideCaps(closed.openings(), kNarrowCap * grid->errorBound(), narrow);
  return FieldAccess::make(std::move(grid), std::move(caps), closed.moved() + narrow);
}

}  // namespace sdf_ccd
