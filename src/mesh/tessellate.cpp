#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include "common/number_text.h"
#include "common/pi.h"
#include "common/refuse.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxTriangles = 50'000'000;

TriangleMesh icosahedron(double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vector3d& v : mesh.vertices) v *= radius / v.norm();
  return mesh;
}

/// Splits every triangle into four, with the new vertices on the sphere.
TriangleMesh refined(const TriangleMesh& mesh, double radius) {
  TriangleMesh result;
  result.vertices = mesh.vertices;
  result.triangles.reserve(4 * mesh.triangles.size());
  std::unordered_map<std::uint64_t, int> middles;
  middles.reserve(2 * mesh.triangles.size());
  const auto middle = [&](int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const std::uint64_t key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
    const auto [entry, is_new] = middles.try_emplace(key, static_cast<int>(result.vertices.size()));
    if (is_new) {
      const Vector3d sum = result.vertices[a] + result.vertices[b];
      result.vertices.push_back(sum * (radius / sum.norm()));
    }
    return entry->second;
  };
  for (const Vector3i& t : mesh.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    result.triangles.insert(result.triangles.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
  }
  return result;
}

/// Largest distance of the sphere from its inscribed triangles.
double deviation(const TriangleMesh& mesh, double radius) {
  double worst = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d normal = areaNormal(mesh, static_cast<int>(i)).normalized();
    worst = std::max(worst, radius - normal.dot(mesh.vertices[mesh.triangles[i][0]]));
  }
  return worst;
}

struct Tessellate {
  double max_deviation;

  TriangleMesh operator()(const Sphere& sphere) const {
    TriangleMesh mesh = icosahedron(sphere.radius);
    while (deviation(mesh, sphere.radius) > max_deviation) {
      requireRoom(4 * mesh.triangles.size());
      mesh = refined(mesh, sphere.radius);
    }
    return mesh;
  }

  TriangleMesh operator()(const Box& box) const {
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
      mesh.vertices.push_back(box.halfSize().cwiseProduct(sign));
    }
    constexpr std::array<std::array<int, 4>, 6> kFaces = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& face : kFaces) {
      mesh.triangles.emplace_back(face[0], face[1], face[2]);
      mesh.triangles.emplace_back(face[0], face[2], face[3]);
    }
    return mesh;
  }

  /// A prism: the sides of a polygon with n corners are up to r(1 − cos(π/n)) from its circle.
  TriangleMesh operator()(const Cylinder& cylinder) const {
    const double ratio = std::min(max_deviation / cylinder.radius, 1.0);
    // 1 − cos x = 2 sin²(x/2), which does not cancel for small x.
    const double sides = std::max(8.0, std::ceil(kPi / (2 * std::asin(std::sqrt(ratio / 2)))));
    requireRoom(sides < 1e12 ? static_cast<std::size_t>(4 * sides) : kMaxTriangles + 1);
    const int n = static_cast<int>(sides);
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, -cylinder.halfLength()}, {0, 0, cylinder.halfLength()}};
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * kPi * i / n;
      const double x = cylinder.radius * std::cos(angle), y = cylinder.radius * std::sin(angle);
      mesh.vertices.emplace_back(x, y, -cylinder.halfLength());
      mesh.vertices.emplace_back(x, y, cylinder.halfLength());
      const int low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % n);
      mesh.triangles.emplace_back(0, next, low);
      mesh.triangles.emplace_back(1, low + 1, next + 1);
      mesh.triangles.emplace_back(low, next, next + 1);
      mesh.triangles.emplace_back(low, next + 1, low + 1);
    }
    return mesh;
  }

  TriangleMesh operator()(const HalfSpace&) const {
    throw std::invalid_argument("a half-space has no bounded surface to tessellate");
  }

  void requireRoom(std::size_t triangles) const {
    if (triangles <= kMaxTriangles) return;
    throw std::length_error(
        fmt::format("a deviation of {:g} m needs more than {} triangles", max_deviation, kMaxTriangles));
  }
};

}  // namespace

TriangleMesh tessellate(const Primitive& primitive, double max_deviation) {
  validate(primitive);
  if (!(max_deviation > 0)) {
    refuse("the deviation of a tessellation must be positive, not " + numberText(max_deviation));
  }
  return std::visit(Tessellate{max_deviation}, primitive);
}

}  // namespace sdf_ccd
