#include "scene/body_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "mesh/mesh_edges.h"
#include "mesh/voxel_rectangles.h"
#include "surface/box_tree_ray.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxTriangles = 8'000'000;              // about a gigabyte
constexpr std::size_t kMaxVoxelBytes = std::size_t{1} << 28;  // of the box around the occupied ones, a bit each

/// Deviation of a cylinder's triangles [m]: a fiftieth of the default error of verdicts, or more for radii beyond 5 m,
/// which would need more than 3,500 sides.
double cylinderDeviation(const Cylinder& cylinder) {
  constexpr double kFine = 2e-6, kOfRadius = 4e-7;
  return std::max(kFine, kOfRadius * cylinder.radius);
}

/// The extreme vertices along some directions; each once.
std::vector<Vector3d> farthestOut(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> farthest;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vector3d direction(x, y, z);
        if (direction.isZero()) continue;
        const Vector3d& p = *std::max_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
          return direction.dot(a) < direction.dot(b);
        });
        if (std::find(farthest.begin(), farthest.end(), p) == farthest.end()) farthest.push_back(p);
      }
  return farthest;
}

class Collector {
 public:
  void add(const Sphere& ball, const Isometry3d& X_BG) {
    const Vector3d center = X_BG.translation();
    triangles.push_back({{center, center, center}, ball.radius});
    std::vector<Vector3d> points;
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) points.push_back(center + side * ball.radius * Vector3d::Unit(k));
    components.push_back(points);
  }

  void add(const TriangleMesh& mesh, const Isometry3d& X_BG) {
    addTriangles(mesh, X_BG);
    addComponents(mesh, X_BG);
  }

  void addTriangles(const TriangleMesh& mesh, const Isometry3d& X_BG) {
    for (const Vector3i& t : mesh.triangles)
      triangles.push_back({{X_BG * mesh.vertices[t[0]], X_BG * mesh.vertices[t[1]], X_BG * mesh.vertices[t[2]]}, 0.0});
  }

  void addComponents(const TriangleMesh& mesh, const Isometry3d& X_BG) {
    const std::vector<std::int32_t> component = componentOfVertices(mesh);
    std::map<std::int32_t, std::vector<Vector3d>> points;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (component[v] >= 0) points[component[v]].push_back(X_BG * mesh.vertices[v]);
    for (const auto& [set, of_set] : points) components.push_back(farthestOut(of_set));
  }

  /// Triangles added since the last call are another element.
  void endElement() { elements.resize(triangles.size(), elements.empty() ? 0 : elements.back() + 1); }

  std::vector<RoundedTriangle> triangles;
  std::vector<int> elements;  // per triangle
  std::vector<std::vector<Vector3d>> components;
};

void requireRoom(std::size_t triangles) {
  if (triangles > kMaxTriangles)
    throw std::invalid_argument(std::to_string(triangles) + " triangles, more than the " +
                                std::to_string(kMaxTriangles) + " that a body may have");
}

std::shared_ptr<const BodyTriangles> ownTrianglesOf(const BodyDescription& description, MeshPool& pool) {
  Collector all;
  double deviation = 0.0;
  std::vector<BodyTriangles::Voxels> voxels;
  for (const GeometryDescription& geometry : description.geometry) {
    if (isHalfSpace(geometry)) continue;
    if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
      if (const auto* ball = std::get_if<Sphere>(primitive)) {
        all.add(*ball, geometry.X_BG);
      } else {
        const auto* cylinder = std::get_if<Cylinder>(primitive);
        const double fine = cylinder ? cylinderDeviation(*cylinder) : 1.0;
        if (cylinder) deviation = std::max(deviation, fine);
        all.add(tessellate(*primitive, fine), geometry.X_BG);
      }
    } else if (PooledMesh& pooled = pool.find(geometry); geometry.watertight_voxels) {
      const std::shared_ptr<const VoxelSolid>& solid = SolidSource(pooled.mesh, pooled.made).voxels();
      if (!solid) throw std::invalid_argument(geometry.source + ": its faces are not those of whole voxels");
      if (solid->bytes() > kMaxVoxelBytes)
        throw std::invalid_argument(geometry.source + ": the box around its voxels needs " +
                                    std::to_string(solid->bytes() >> 20) + " MB, more than " +
                                    std::to_string(kMaxVoxelBytes >> 20));
      deviation = std::max(deviation, solid->moved());
      all.addTriangles(boundaryRectangles(*solid), geometry.X_BG);
      all.addComponents(pooled.mesh, geometry.X_BG);
      const int element = all.elements.empty() ? 0 : all.elements.back() + 1;
      voxels.push_back({element, geometry.X_BG.inverse(), solid});
    } else {
      all.add(pooled.mesh, geometry.X_BG);
    }
    all.endElement();
    requireRoom(all.triangles.size());
  }
  if (all.triangles.empty()) return nullptr;
  std::vector<int> order;
  auto made = std::make_shared<BodyTriangles>(BoxTree(all.triangles, &order));
  made->elements = all.elements.back() + 1;
  if (made->elements > 1)
    for (const int i : order) made->element.push_back(all.elements[static_cast<std::size_t>(i)]);
  made->deviation = deviation;
  made->voxels = std::move(voxels);
  const std::size_t open = all.triangles.size();
  for (const GeometryDescription& geometry : description.geometry) {
    if (std::holds_alternative<Primitive>(geometry.shape) || geometry.watertight_voxels) continue;
    PooledMesh& pooled = pool.find(geometry);
    if (isClosed(pooled.mesh)) continue;
    // The boundary of the solid is the whole mesh, and closed with the caps, or where its faces are joined.
    const ClosedSolid& solid = SolidSource(pooled.mesh, pooled.made).closed();
    all.add(solid.openings().caps, geometry.X_BG);
    made->is_cracked = made->elements == 1 && solid.hasCracksAlone();
    made->deviation = std::max(made->deviation, solid.moved());
  }
  made->components = std::move(all.components);
  if (all.triangles.size() > open) made->closed = std::make_unique<BoxTree>(all.triangles);
  return made;
}

/// Of a point in the body's frame from the faces of voxels, by which it may be on either side [m].
double slackOf(const BodyTriangles::Voxels& voxels, const Vector3d& p) {
  const VoxelSolid& solid = *voxels.solid;
  return solid.moved() + 1e-14 * (p.norm() + solid.box().max().norm() + solid.origin().norm());
}

}  // namespace

std::size_t BodyTriangles::bytes() const {
  std::size_t bytes = tree.bytes() + (closed ? closed->bytes() : 0) + element.size() * sizeof(element[0]);
  for (const Voxels& of_map : voxels) bytes += of_map.solid->bytes();
  return bytes;
}

const BodyTriangles::Voxels* BodyTriangles::voxelsOf(int element_index) const {
  const auto of =
      std::find_if(voxels.begin(), voxels.end(), [&](const Voxels& v) { return v.element == element_index; });
  return of == voxels.end() ? nullptr : &*of;
}

std::optional<int> BodyTriangles::windingNumberOf(int k, const Vector3d& p) const {
  return windingNumber(tree, p, [&](int i) { return elements == 1 || element[static_cast<std::size_t>(i)] == k; });
}

bool BodyTriangles::isOutside(const Vector3d& p) const {
  for (int k = 0; k < elements; ++k) {
    if (const Voxels* const of_map = voxelsOf(k)) {
      if (of_map->solid->touches(of_map->X_GB * p, slackOf(*of_map, p))) return false;
    } else if (windingNumberOf(k, p) != 0) {
      return false;
    }
  }
  return true;
}

bool BodyTriangles::isInside(const Vector3d& p) const {
  if (closed && is_cracked) return windingNumber(*closed, p, [](int) { return true; }).value_or(0) != 0;
  for (int k = 0; k < elements; ++k) {
    if (const Voxels* const of_map = voxelsOf(k)) {
      if (of_map->solid->contains(of_map->X_GB * p, slackOf(*of_map, p))) return true;
    } else if (!closed && windingNumberOf(k, p).value_or(0) != 0) {
      return true;
    }
  }
  return false;
}

std::shared_ptr<const BodyTriangles> trianglesOf(const BodyDescription& description, MeshPool& pool) {
  WeakStore<BodyTriangles>& shared = pool.content().triangles;
  const std::string key = pool.keys().keyOf(description);
  if (auto known = shared.find(key)) return known;
  auto made = ownTrianglesOf(description, pool);
  return made ? shared.keep(key, std::move(made)) : nullptr;
}

}  // namespace sdf_ccd
