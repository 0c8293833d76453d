#include "sdf_ccd/geometry/mesh_quality.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "closed_components.h"
#include "conforming_mesh.h"
#include "duplicate_triangles.h"
#include "geometry/corners.h"
#include "geometry/trees/triangle_tree.h"
#include "hidden_walls.h"
#include "mesh_patches.h"
#include "open_components.h"
#include "sdf_ccd/common/cancel.h"
#include "self_crossing.h"

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

/// What orienting the closed patches of a mesh has shown of all of them together.
struct ClosedPatches {
  int closed = 0, flipped = 0, cavities = 0, flat = 0, mixed = 0;
  bool doubtful = false;

  /// Whether all closed patches are whole solids in the orientation in which they are drawn, side by side or
  /// overlapping.
  bool isPlain() const { return flipped == 0 && cavities == 0 && flat == 0 && mixed == 0; }
};

/// Whether a flipped patch meets others in an edge, so that one may have been cut out of the other.
bool flippedMeetsOthers(const std::vector<Patch>& patches, const std::vector<ClosedComponent>& closed,
                        const TriangleMesh& mesh) {
  std::vector<char> flipped(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!closed[i].flip) continue;
    for (const std::int32_t triangle : patches[i].triangles) flipped[triangle] = 1;
  }
  bool found = false;
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first <= 2 || found) return;
    const auto of_flipped = std::count_if(first, last, [&](const EdgeUse& use) { return flipped[use.triangle] != 0; });
    found = of_flipped > 0 && of_flipped < last - first;
  });
  return found;
}

bool isFlippedClosed(const Patch& patch, const TriangleMesh& drawn, const TriangleMesh& flipped) {
  const std::int32_t first = patch.triangles.front();
  return patch.closed && drawn.triangles[first] != flipped.triangles[first];
}

/// Whether a flipped patch touches itself: it may be two parts, joined where faces were tessellated separately.
bool flippedTouchesItself(const std::vector<Patch>& patches, const TriangleMesh& drawn, const TriangleMesh& flipped) {
  return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
    if (!isFlippedClosed(patch, drawn, flipped)) return false;
    const TriangleMesh part = extract(flipped, patch);
    return touchesItself(part, TriangleTree(part));
  });
}

AlignedBox3d boxOf(const TriangleMesh& mesh, const Patch& patch) {
  AlignedBox3d box;
  for (const std::int32_t triangle : patch.triangles)
    for (const int vertex : mesh.triangles[triangle]) box.extend(mesh.vertices[vertex]);
  return box;
}

/// Distance from a triangle at which seesOutside() is queried: more than it widens triangles by [m].
double stepFrom(const TriangleMesh& mesh) {
  return 1e-5 * boundingBox(mesh).sizes().maxCoeff();
}

/// Whether a point just outside some triangle of the patch sees the outside. Of a large patch only some are tried.
bool isSeen(const TriangleMesh& mesh, const Patch& patch, const TriangleTree& tree, double step) {
  constexpr std::size_t kMaxTries = 256;
  const std::size_t stride = 1 + patch.triangles.size() / kMaxTries;
  for (std::size_t i = 0; i < patch.triangles.size(); i += stride) {
    checkCancelled();
    const std::int32_t triangle = patch.triangles[i];
    const Vector3d normal = areaNormal(mesh, triangle).normalized();
    if (tree.seesOutside(centroid(cornersOf(mesh, triangle)) + step * normal)) return true;
  }
  return false;
}

/// Whether a closed patch that was flipped is hidden behind open ones: it may be a cavity in a solid whose hull does
/// not quite meet, as well as a part drawn inside out.
bool flippedMayBeCavity(const std::vector<Patch>& patches, const TriangleMesh& drawn, const TriangleMesh& flipped) {
  AlignedBox3d open;
  for (const Patch& patch : patches)
    if (!patch.closed) open.extend(boxOf(drawn, patch));
  std::optional<TriangleTree> tree;
  return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
    if (!isFlippedClosed(patch, drawn, flipped) || !open.contains(boxOf(drawn, patch))) return false;
    if (!tree) tree.emplace(drawn);
    return !isSeen(flipped, patch, *tree, stepFrom(drawn));
  });
}

ClosedPatches flipClosed(const std::vector<Patch>& patches, TriangleMesh& mesh, MeshQuality& quality) {
  ClosedPatches all;
  const std::vector<ClosedComponent> closed = inspectClosed(mesh, patches);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    all.closed += patches[i].closed;
    all.flipped += closed[i].flip;
    all.cavities += closed[i].cavity;
    all.flat += closed[i].flat;
    all.mixed += patches[i].closed && patches[i].mixed;
    all.doubtful = all.doubtful || closed[i].doubtful;
    quality.negative_triangles += closed[i].negative_triangles;
    quality.solid_within = quality.solid_within || closed[i].solid_within;
    if (closed[i].flip) flip(mesh, patches[i]);
  }
  quality.inverted_components = all.flipped;
  all.doubtful = all.doubtful || (all.flipped > 0 && flippedMeetsOthers(patches, closed, mesh));
  return all;
}

/// Whether some wall has a side that cannot see the outside: such walls may be all that is left of a part that was
/// drawn inside out, where it is flush with the parts that contain it.
bool enclose(const std::vector<Vector3i>& walls, TriangleMesh mesh) {
  if (walls.empty()) return false;
  const std::size_t first = mesh.triangles.size();
  mesh.triangles.insert(mesh.triangles.end(), walls.begin(), walls.end());
  const TriangleTree tree(mesh);
  const double step = stepFrom(mesh);
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
    checkCancelled();
    const Vector3d center = centroid(cornersOf(mesh, static_cast<int>(i)));
    const Vector3d normal = areaNormal(mesh, static_cast<int>(i)).normalized();
    if (!tree.seesOutside(center + step * normal) || !tree.seesOutside(center - step * normal)) return true;
  }
  return false;
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
  const TriangleMesh drawn = likeness;
  const ClosedPatches closed = flipClosed(patches, likeness, quality);
  // Two parts that were tessellated separately may have been joined at a common edge, and cancel each other.
  const bool is_joined = joined.mesh.triangles.size() != result.mesh.triangles.size();
  bool doubtful = closed.doubtful || (is_joined && quality.negative_triangles > 0);
  doubtful = doubtful || (is_joined && closed.flipped > 0 && flippedTouchesItself(patches, drawn, likeness));
  // Of a part that is drawn twice, one may be a solid and the other not.
  const bool some_flipped = closed.flipped > 0 && closed.flipped < closed.closed;
  doubtful = doubtful || (quality.duplicate_triangles > 0 && (closed.cavities > 0 || some_flipped));
  doubtful = doubtful || (closed.flipped > 0 && flippedMayBeCavity(patches, drawn, likeness));
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
  quality.doubtful =
      doubtful || (!walls.empty() && (quality.negative_triangles > 0 || !closed.isPlain())) || enclose(walls, likeness);
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
