#include "sdf_ccd/geometry/mesh_quality.h"

#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "duplicate_triangles.h"
#include "mesh_patches.h"
#include "sdf_ccd/geometry/triangle_tree.h"

namespace sdf_ccd {
namespace {

/// A patch that may be inside out, with what is needed to find out.
struct Part {
  TriangleMesh mesh;
  AlignedBox3d box;
  double volume;
  std::optional<TriangleTree> tree;  // built when first asked
};

bool liesInside(const Part& inner, Part& outer) {
  if (!outer.box.contains(inner.box)) return false;
  if (!outer.tree) outer.tree.emplace(outer.mesh);
  constexpr std::size_t kSamples = 64;
  const std::size_t step = std::max<std::size_t>(1, inner.mesh.vertices.size() / kSamples);
  for (std::size_t i = 0; i < inner.mesh.vertices.size(); i += step) {
    // The outer part may itself still be inside out.
    if (std::abs(outer.tree->windingNumber(inner.mesh.vertices[i])) <= 0.5) return false;
  }
  return true;
}

bool isCavity(std::vector<Part>& parts, std::size_t index) {
  for (std::size_t other = 0; other < parts.size(); ++other) {
    if (other != index && liesInside(parts[index], parts[other])) return true;
  }
  return false;
}

/// Whether an open patch is the mesh's outer skin inside out: it reaches at least four sides of the mesh's box, and
/// of the volumes that its triangles span with the box's centre, those of triangles that face the centre outweigh
/// the others three to one. Smaller patches stay as they are: the wall of a hole faces the centre rightly.
bool isInvertedSkin(const Part& part, const AlignedBox3d& box) {
  const Vector3d margin = 0.01 * box.sizes();
  const int sides = static_cast<int>(((part.box.min() - box.min()).array() <= margin.array()).count() +
                                     ((box.max() - part.box.max()).array() <= margin.array()).count());
  if (sides < 4) return false;
  double sum = 0, absolute = 0;
  for (std::size_t i = 0; i < part.mesh.triangles.size(); ++i) {
    const Vector3d& corner = part.mesh.vertices[part.mesh.triangles[i][0]];
    const double volume = (corner - box.center()).dot(areaNormal(part.mesh, static_cast<int>(i)));
    sum += volume;
    absolute += std::abs(volume);
  }
  return sum < -0.5 * absolute;
}

/// Counts what edges tell before anything is turned.
void inspectEdges(const TriangleMesh& mesh, MeshQuality& quality) {
  TriangleSets sets(mesh.triangles.size());
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    const auto count = last - first;
    if (count == 1) ++quality.boundary_edges;
    if (count == 2 && first[0].forward == first[1].forward) ++quality.misoriented_edges;
    if (count > 2) ++quality.non_manifold_edges;
    for (const EdgeUse* use = first + 1; use < last; ++use) sets.join(first->triangle, use->triangle);
  });
  std::set<std::int32_t> roots;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) roots.insert(sets.find(static_cast<std::int32_t>(i)));
  quality.components = static_cast<int>(roots.size());
}

}  // namespace

OrientedMesh orientOutward(const TriangleMesh& mesh) {
  validate(mesh);
  OrientedMesh result;
  MeshQuality& quality = result.quality;
  const TriangleMesh weld = welded(mesh);
  if (weld.triangles.empty()) throw std::invalid_argument("no triangle of the mesh has three different corners");
  result.mesh = withoutDuplicates(weld);
  quality.degenerate_triangles = static_cast<int>(mesh.triangles.size() - weld.triangles.size());
  for (std::size_t i = 0; i < result.mesh.triangles.size(); ++i) {
    quality.degenerate_triangles += areaNormal(result.mesh, static_cast<int>(i)).squaredNorm() == 0;
  }
  inspectEdges(result.mesh, quality);

  const std::vector<Patch> patches = orientConsistently(result.mesh);
  quality.box = boundingBox(result.mesh);
  quality.sign_trusted = true;
  std::vector<Part> parts;
  for (const Patch& patch : patches) {
    Part part{extract(result.mesh, patch), {}, 0, std::nullopt};
    part.box = boundingBox(part.mesh);
    part.volume = signedVolume(part.mesh);
    parts.push_back(std::move(part));
    quality.sign_trusted = quality.sign_trusted && patch.closed;
  }
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].closed ? parts[i].volume < 0 && !isCavity(parts, i) : isInvertedSkin(parts[i], quality.box)) {
      flip(result.mesh, patches[i]);
      quality.inverted_components += patches[i].closed;
    }
  }
  quality.triangles = static_cast<int>(result.mesh.triangles.size());
  quality.volume = signedVolume(result.mesh);
  quality.area = surfaceArea(result.mesh);
  return result;
}

std::string summary(const MeshQuality& quality) {
  std::ostringstream text;
  text.precision(3);
  const auto count = [&](int number, const char* one, const char* many) {
    if (number > 0) text << ", " << number << " " << (number == 1 ? one : many);
  };
  text << quality.triangles << (quality.triangles == 1 ? " triangle" : " triangles");
  if (quality.components > 1) text << ", " << quality.components << " components";
  count(quality.degenerate_triangles, "degenerate triangle", "degenerate triangles");
  if (quality.boundary_edges == 0) text << ", closed";
  count(quality.boundary_edges, "boundary edge", "boundary edges");
  count(quality.non_manifold_edges, "non-manifold edge", "non-manifold edges");
  count(quality.misoriented_edges, "misoriented edge", "misoriented edges");
  count(quality.inverted_components, "inverted component turned round", "inverted components turned round");
  text << ", volume " << quality.volume << " m^3, sign " << (quality.sign_trusted ? "trusted" : "doubtful");
  return text.str();
}

}  // namespace sdf_ccd
