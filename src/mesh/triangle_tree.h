#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/infinity.h"
#include "mesh/corners.h"
#include "mesh/flat_cylinder.h"
#include "mesh/triangle.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Box hierarchy over the triangles of a mesh, for closest points and winding numbers.
///
/// For closest points four nodes are tested at a time, by flat cylinders besides their boxes: seen from afar, many
/// boxes are about as near as the surface, but few cylinders are. Also holds, per node, the expansion of Barill et al.
/// 2018 up to second order about the node's area-weighted centre. Copies the triangles in tree order, so the mesh need
/// not outlive it. Queries are thread-safe.
class TriangleTree {
 public:
  /// @throws std::invalid_argument if the mesh is not valid (see validate()).
  explicit TriangleTree(const TriangleMesh& mesh);

  struct ClosestPoint {
    Vector3d point;   ///< on the mesh
    double distance;  ///< [m], unsigned
    int triangle;     ///< index in the mesh
  };

  /// A triangle by its index in the mesh.
  const MeasuredTriangle& triangle(int i) const { return triangles_[positions_[i]]; }

  /// Closest point of the mesh to p, if nearer than `max_distance`; triangle is -1 (distance `max_distance`) if not.
  ClosestPoint closestPoint(const Vector3d& p, double max_distance = kInfinity) const;

  /// The same for a sequence of query points: `likely`, a triangle of the mesh, is tested first. The nearer it is, the
  /// fewer others are visited; the distance found does not depend on it.
  ClosestPoint closestPointNear(const Vector3d& p, int likely) const;

  /// Distance of p from one triangle of the mesh [m].
  double distanceTo(int triangle, const Vector3d& p) const {
    return (triangles_[positions_[triangle]].closest(p) - p).norm();
  }

  /// Triangles within `radius` of p: replaces `triangles` by their indices in the mesh, in no order.
  void trianglesWithin(const Vector3d& p, double radius, std::vector<int>& triangles) const;

  /// The same for the smallest ball about a triangle's centroid that holds it, made larger by `margin` [m].
  void trianglesNear(const Corners& c, double margin, std::vector<int>& triangles) const {
    const Vector3d center = centroid(c);
    trianglesWithin(center, farthestDistance(c, center) + margin, triangles);
  }

  /// The largest n·(x − p) of all corners x of triangles within `radius` of p, or −radius if none is larger [m]. Once
  /// that exceeds `limit`, some value above it is returned.
  double farthestAlong(const Vector3d& n, const Vector3d& p, double radius, double limit) const;

  /// The first triangle, by its index in the mesh, that the ray from p along the unit vector `direction` meets farther
  /// than `min_distance` from p; -1 if there is none. Up to rounding: a ray along an edge may meet either side or none.
  int firstHit(const Vector3d& p, const Vector3d& direction, double min_distance) const;

  /// Whether some ray from p meets no triangle, and passes none by less than 4e-6 of the mesh's size: no ray escapes
  /// through cracks that conformingMesh() closes. False wherever triangles enclose p, in whatever orientation; true at
  /// most other points.
  bool seesOutside(const Vector3d& p) const;

  /// Visits triangles for which mayMatter(center, radius) [m] is true for spheres that contain them: it is called for
  /// spheres around ever fewer triangles, at last around a single one.
  template <typename MayMatter, typename Visit>
  void forEachTriangle(MayMatter mayMatter, Visit visit) const;

  /// Generalised winding number (Jacobson 2013): 1 inside and 0 outside a closed mesh. Hierarchical (Barill et al.
  /// 2018): far clusters are replaced by their expansion. The error is mostly below 0.02, but grows with the number of
  /// triangles that lie on each other: to decide a side, use inside().
  /// @param accuracy  clusters nearer than accuracy × their radius are opened; infinity sums every triangle.
  double windingNumber(const Vector3d& p, double accuracy = 2.0) const;

  /// How the winding number decides whether a point is inside.
  enum class Inside {
    kNotZero,    ///< for a closed mesh, where the number is an integer (see isClosed())
    kAboveHalf,  ///< for an open one
  };

  /// Whether p is inside. Each expansion's remainder is bounded, and nodes are opened until the sum of the bounds
  /// cannot change the answer. Only rounding remains, which decides on the surface (and, for an open mesh, where the
  /// number is one half).
  /// @param visited  if given, the number of visited nodes and triangles is added to it.
  bool inside(const Vector3d& p, Inside rule, std::size_t* visited = nullptr) const;

  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + quads_.size() * sizeof(Quad) + expansions_.size() * sizeof(Expansion) +
           triangles_.size() * sizeof(Triangle) + (ids_.size() + positions_.size()) * sizeof(std::int32_t);
  }

 private:
  using Triangle = MeasuredTriangle;
  /// Children are consecutive and come after their parent.
  struct Node {
    AlignedBox3d box;
    std::int32_t first;  ///< first child, or first triangle of a leaf
    std::int32_t count;  ///< triangles of a leaf; 0 for an inner node
  };
  /// Expansion of the field r·n/(4π|r|³) of a node's dipoles, r from the query to `center`. That field is the
  /// gradient of a harmonic function, so only the symmetric part without trace of each moment matters.
  struct Expansion {
    Vector3d center;
    double radius2;                 ///< of the ball about `center` that holds the node's triangles
    Vector3d dipole;                ///< Σ area · normal
    std::array<double, 6> first;    ///< xx, yy, zz, xy, xz, yz
    std::array<double, 10> second;  ///< xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz
    double spread;                  ///< upper bound of ∫ |d|³ over the triangles, d from `center`
  };

  /// Four nodes side by side, for closest points: the children or grandchildren of a node. Unused ones are infinitely
  /// far away.
  struct Quad {
    using Lane = std::array<double, 4>;

    std::array<Lane, 3> low, high;     ///< boxes
    std::array<Lane, 3> center, axis;  ///< cylinders
    Lane radius, half_height;
    std::array<std::int32_t, 4> first;  ///< quad, or first triangle of a leaf
    std::array<std::int32_t, 4> count;  ///< triangles of a leaf; else 0
  };

  class Builder;
  /// Lower bounds of the squared distances of a quad's nodes, by their boxes and their cylinders.
  static void leastDistances2(const Quad& quad, const Vector3d& p, double* least);
  void search(const Vector3d& p, double best2, ClosestPoint& best) const;
  int firstHit(const Vector3d& p, const Vector3d& direction, double min_distance, double slack) const;
  static Expansion expand(const Triangle* begin, const Triangle* end);
  /// A winding number, and a bound on its error without rounding.
  struct BoundedNumber {
    double value = 0.0;
    double error = 0.0;
    std::size_t visited = 0;  ///< nodes and triangles
  };
  static BoundedNumber evaluate(const Expansion& expansion, const Vector3d& r, double distance2);
  /// Opens nodes nearer than accuracy × their radius (at least twice it), and those whose own error exceeds the bound.
  BoundedNumber boundedNumber(const Vector3d& p, double accuracy, double bound) const;

  std::vector<Node> nodes_;
  std::vector<Quad> quads_;              ///< the root's first; none if it is a leaf
  std::vector<Expansion> expansions_;    ///< one per node
  std::vector<Triangle> triangles_;      ///< in tree order
  std::vector<std::int32_t> ids_;        ///< index in the mesh of each of `triangles_`
  std::vector<std::int32_t> positions_;  ///< index in `triangles_` of each of the mesh's
};

template <typename MayMatter, typename Visit>
void TriangleTree::forEachTriangle(MayMatter mayMatter, Visit visit) const {
  std::vector<std::int32_t> pending = {0};
  while (!pending.empty()) {
    const Node& node = nodes_[pending.back()];
    pending.pop_back();
    if (!mayMatter(node.box.center(), 0.5 * node.box.diagonal().norm())) continue;
    if (node.count == 0) {
      pending.push_back(node.first);
      pending.push_back(node.first + 1);
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      if (mayMatter(triangles_[i].center(), triangles_[i].radius())) visit(ids_[i]);
    }
  }
}

}  // namespace sdf_ccd
