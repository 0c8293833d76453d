#include "openings.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "common/counted.h"
#include "loop_cap.h"
#include "mesh/mesh_patches.h"
#include "reach_bound.h"
#include "rim.h"
#include "solid/side_check.h"

namespace sdf_ccd {
namespace {

constexpr double kFinestJoin = 1e-8, kCrack = 1e-4;  // of the mesh's diagonal

/// Caps of the mesh's rims after these are joined up to a tolerance. Their vertices are the mesh's.
Openings capped(const TriangleMesh& mesh, double diagonal, double widest) {
  Openings openings;
  openings.crack = widest * diagonal;
  Rim rim(mesh);
  for (double share = kFinestJoin; share < 1.001 * widest && !rim.empty(); share *= 10.0) rim.join(share * diagonal);
  if (!rim.empty()) rim.join(openings.crack);
  const std::vector<std::vector<int>> loops = rim.takeLoops();
  openings.count = static_cast<int>(loops.size());
  openings.caps.vertices = mesh.vertices;
  openings.caps.triangles = rim.triangles();
  for (const std::vector<int>& loop : loops) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      length += (mesh.vertices[loop[(i + 1) % loop.size()]] - mesh.vertices[loop[i]]).norm();
    }
    openings.longest = std::max(openings.longest, length);
  }
  for (const LoopCap& cap : capLoops(mesh.vertices, loops)) {
    openings.area += cap.area;
    openings.caps.triangles.insert(openings.caps.triangles.end(), cap.triangles.begin(), cap.triangles.end());
  }
  return openings;
}

}  // namespace

Openings findOpenings(const TriangleMesh& mesh) {
  validate(mesh);
  if (isClosed(mesh)) return {};
  const TriangleMesh weld = welded(mesh);
  if (weld.triangles.empty() || isClosed(weld)) return {};
  const double diagonal = boundingBox(weld).diagonal().norm();
  Openings openings = capped(weld, diagonal, kCrack);
  const SideCheck check(weld);
  std::vector<Vector3i> missing = check.missing(openings);
  constexpr double kMuch = 0.05;
  for (const double widest : {1e-3, 1e-2, 1.0 / 30.0}) {
    if (openings.doubt <= kMuch) break;
    Openings wider = capped(weld, diagonal, widest);
    std::vector<Vector3i> wider_missing = check.missing(wider);
    if (wider.doubt >= openings.doubt) continue;
    openings = std::move(wider);
    missing = std::move(wider_missing);
  }
  if (!missing.empty()) check.addVoxels(missing, openings);
  Patch caps;
  caps.triangles.resize(openings.caps.triangles.size());
  std::iota(caps.triangles.begin(), caps.triangles.end(), 0);
  openings.caps = extract(openings.caps, caps);  // without unused vertices
  ReachBound reach(check.tree(), kCrack * diagonal);
  for (const Vector3i& t : openings.caps.triangles) {
    openings.reach.push_back(reach.of(cornersOf(openings.caps.vertices, t)));
  }
  return openings;
}

std::string summary(const Openings& openings) {
  std::string text = openings.caps.triangles.empty() ? "no openings" : "no openings beyond cracks";
  if (openings.count > 0) {
    text = fmt::format("{}, the longest {:.3g} m around, {:.3g} m^2 of caps", counted(openings.count, "opening"),
                       openings.longest, openings.area);
  }
  if (openings.doubt > 0.0) text += fmt::format(", doubtful in {:.3g} % of the interior", 100.0 * openings.doubt);
  if (openings.voxels > 0) text += fmt::format(", {} voxels treated as inside", openings.voxels);
  return text;
}

}  // namespace sdf_ccd
