#include "sdf_ccd/mesh.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "closed_components.h"
#include "common/cancel_point.h"
#include "conforming_mesh.h"
#include "hidden_walls.h"
#include "mesh/corners.h"
#include "mesh/duplicate_triangles.h"
#include "mesh/mesh_patches.h"
#include "open_components.h"

namespace sdf_ccd {
namespace {

/// Counts components and kinds of edges, before any triangle is flipped.
void inspectEdges(const TriangleMesh& mesh, MeshQuality& quality) {
  TriangleSets sets(mesh.triangles.size());
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    const auto count = last - first;
    if (count == 1) ++quality.boundary_edges;
    if (count == 2 && first[0].forward == first[1].forward) ++quality.misoriented_edges;
    if (count > 2) ++quality.non_manifold_edges;
    for (const EdgeUse* use = first + 1; use < last; ++use) sets.join(first->triangle, use->triangle);
  });
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.triangles.size()); ++i) {
    quality.components += sets.find(i) == i;
  }
}

/// Flips triangles of `mesh` as their parts are flipped in `flipped`.
/// @return whether all parts of each triangle agree.
bool flipAsParts(const ConformingMesh& parts, const TriangleMesh& flipped, TriangleMesh& mesh) {
  std::vector<char> flips(mesh.triangles.size(), 0);
  bool agree = true;
  for (std::size_t i = 0; i < parts.source.size(); ++i) {
    const std::int32_t source = parts.source[i];
    const char is_flipped = flipped.triangles[i] != parts.mesh.triangles[i];
    agree = agree && (i == 0 || parts.source[i - 1] != source || flips[source] == is_flipped);
    flips[source] = is_flipped;
  }
  for (std::size_t i = 0; i < flips.size(); ++i) {
    if (flips[i]) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
  return agree;
}

/// Flips closed patches outward.
/// @return whether it is doubtful what is inside.
bool flipClosed(const std::vector<Patch>& patches, TriangleMesh& mesh, MeshQuality& quality) {
  const std::vector<ClosedComponent> closed = inspectClosed(mesh, patches);
  bool doubtful = false, has_cavity = false;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    has_cavity = has_cavity || closed[i].cavity;
    doubtful = doubtful || closed[i].doubtful || (patches[i].closed && patches[i].mixed && patches.size() > 1);
    quality.inverted_components += closed[i].flip;
    quality.negative_triangles += closed[i].negative_triangles;
    if (closed[i].flip) flip(mesh, patches[i]);
  }
  // Of a part that is drawn twice, one may be a solid and the other a cavity.
  return doubtful || (has_cavity && quality.duplicate_triangles > 0);
}

/// Flips the patches of the mesh outward, and removes the walls that are hidden inside it from `distinct`.
void flipOutward(DistinctTriangles& distinct, OrientedMesh& result) {
  std::vector<Vector3i>& walls = distinct.walls;
  MeshQuality& quality = result.quality;
  const ConformingMesh joined = conformingMesh(result.mesh);
  TriangleMesh likeness = joined.mesh;
  std::vector<Patch> patches = orientConsistently(likeness);
  for (Patch& patch : patches) {
    patch.mixed = patch.mixed || std::any_of(patch.triangles.begin(), patch.triangles.end(), [&](auto triangle) {
                    return !distinct.both_ways.empty() && distinct.both_ways[joined.source[triangle]] != 0;
                  });
  }
  checkCancelled();
  likeness = normalized(std::move(likeness));
  bool doubtful = flipClosed(patches, likeness, quality);
  // Two parts that were tessellated separately may have been joined at a common edge, and cancel each other.
  const bool is_joined = joined.mesh.triangles.size() != result.mesh.triangles.size();
  doubtful = doubtful || (is_joined && (quality.negative_triangles > 0 || quality.inverted_components > 0));
  TriangleMesh hiding = likeness;
  hiding.triangles.insert(hiding.triangles.end(), walls.begin(), walls.end());
  const std::vector<char> from_behind = openPatchesToFlip(hiding, patches);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    quality.inverted_sheets += from_behind[i];
    if (from_behind[i] != 0) flip(likeness, patches[i]);
  }
  const std::vector<char> hidden = hiddenWalls(likeness, patches, walls);
  doubtful = !flipAsParts(joined, likeness, result.mesh) || doubtful;

  std::size_t kept = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (hidden[i] == 0) {
      walls[kept++] = walls[i];
      continue;
    }
    quality.hidden_triangles += 2;
    quality.hidden_area += areaNormal(cornersOf(result.mesh.vertices, walls[i])).norm();
  }
  walls.resize(kept);
  // Walls that are kept may be what is left of a part that another one cancels.
  quality.doubtful = doubtful || !walls.empty();
  quality.sign_trusted = isClosed(likeness) && !quality.doubtful;
}

}  // namespace

OrientedMesh orientOutward(const TriangleMesh& mesh) {
  validate(mesh);
  OrientedMesh result;
  MeshQuality& quality = result.quality;
  const TriangleMesh weld = welded(mesh);
  if (weld.triangles.empty()) throw std::invalid_argument("no triangle of the mesh has three different corners");
  quality.degenerate_triangles = static_cast<int>(mesh.triangles.size() - weld.triangles.size());
  checkCancelled();
  DistinctTriangles distinct = distinctTriangles(weld);
  quality.duplicate_triangles = distinct.copies;
  quality.duplicate_area = distinct.copied_area;
  const std::vector<Vector3i>& walls = distinct.walls;

  result.mesh = distinct.mesh;
  result.mesh.triangles.insert(result.mesh.triangles.end(), walls.begin(), walls.end());
  for (std::size_t i = 0; i < result.mesh.triangles.size(); ++i) {
    quality.degenerate_triangles += areaNormal(result.mesh, static_cast<int>(i)).squaredNorm() == 0;
  }
  checkCancelled();
  inspectEdges(result.mesh, quality);
  checkCancelled();
  quality.box = boundingBox(result.mesh);

  result.mesh = std::move(distinct.mesh);
  flipOutward(distinct, result);
  for (const Vector3i& wall : walls) {
    result.mesh.triangles.push_back(wall);
    result.mesh.triangles.emplace_back(wall[0], wall[2], wall[1]);
  }
  quality.wall_triangles = 2 * static_cast<int>(walls.size());
  quality.triangles = static_cast<int>(result.mesh.triangles.size());
  quality.volume = signedVolume(result.mesh);
  quality.area = surfaceArea(result.mesh);
  return result;
}

}  // namespace sdf_ccd
