#include "geometry/openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "geometry/triangle_tree.h"
#include "loop_cap.h"
#include "rim.h"
#include "sdf_ccd/common/cancel.h"

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

/// Compares the closed mesh with the winding number of the open one on a grid of cells.
class SideCheck {
 public:
  explicit SideCheck(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {
    const AlignedBox3d box = boundingBox(mesh);
    cell_ = box.sizes().maxCoeff() / kCells;
    counts_ = (box.sizes() / cell_).array().ceil().max(1.0).cast<int>();
    origin_ = box.center() - 0.5 * cell_ * counts_.cast<double>();
    winding_.resize(std::size_t(counts_.prod()));
    forEachCell([&](const Vector3i& c) { winding_[index(c)] = tree_.windingNumber(center(c)); });
  }

  const TriangleTree& tree() const { return tree_; }

  /// Sets `openings.doubt`; returns the cells that are clearly inside, but outside of the mesh with its caps.
  std::vector<Vector3i> missing(Openings& openings) const {
    const TriangleTree closed(merged(mesh_, openings.caps));
    std::vector<Vector3i> missing;
    int inside = 0, wrong = 0;
    forEachCell([&](const Vector3i& c) {
      checkCancelled();
      // Cells next to a surface are skipped: their side depends on that surface alone.
      if (closed.closestPoint(center(c), 0.1 * cell_).triangle >= 0) return;
      const double alone = std::abs(winding_[index(c)]);
      const bool closed_inside = std::abs(closed.windingNumber(center(c))) > 0.5;
      const bool clear = alone < 0.1 || alone > 0.9;
      inside += closed_inside || alone > 0.9;
      if (!clear || closed_inside == (alone > 0.5)) return;
      ++wrong;
      if (!closed_inside) missing.push_back(c);
    });
    openings.doubt = inside > 0 ? double(wrong) / inside : 0.0;
    return missing;
  }

  /// Adds the surface of these cells as one body.
  void addVoxels(const std::vector<Vector3i>& cells, Openings& openings) const {
    openings.voxels = static_cast<int>(cells.size());
    std::vector<char> taken(winding_.size(), 0);
    for (const Vector3i& c : cells) taken[index(c)] = 1;
    std::map<std::array<int, 3>, int> corners;
    const auto corner = [&](const Vector3i& c) {
      const auto [place, is_new] =
          corners.try_emplace({c.x(), c.y(), c.z()}, static_cast<int>(openings.caps.vertices.size()));
      if (is_new) openings.caps.vertices.push_back(origin_ + cell_ * c.cast<double>());
      return place->second;
    };
    for (const Vector3i& c : cells) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          Vector3i neighbour = c;
          neighbour[axis] += side;
          const bool within = (neighbour.array() >= 0).all() && (neighbour.array() < counts_.array()).all();
          if (within && taken[index(neighbour)]) continue;
          const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
          const Vector3i low = c + (side > 0 ? Vector3i(Vector3i::Unit(axis)) : Vector3i(Vector3i::Zero()));
          std::array<int, 4> face = {corner(low), corner(low + u), corner(low + u + v), corner(low + v)};
          if (side < 0) std::swap(face[1], face[3]);
          openings.caps.triangles.emplace_back(face[0], face[1], face[2]);
          openings.caps.triangles.emplace_back(face[0], face[2], face[3]);
        }
      }
    }
  }

 private:
  static constexpr int kCells = 20;  // along the longest side

  Vector3d center(const Vector3i& c) const { return origin_ + cell_ * (c.cast<double>().array() + 0.5).matrix(); }
  std::size_t index(const Vector3i& c) const {
    return (std::size_t(c.z()) * counts_.y() + c.y()) * counts_.x() + c.x();
  }
  template <typename Visit>
  void forEachCell(Visit visit) const {
    for (Vector3i c(0, 0, 0); c.z() < counts_.z(); ++c.z())
      for (c.y() = 0; c.y() < counts_.y(); ++c.y())
        for (c.x() = 0; c.x() < counts_.x(); ++c.x()) visit(c);
  }

  const TriangleMesh& mesh_;
  TriangleTree tree_;
  double cell_;
  Vector3i counts_;
  Vector3d origin_;
  std::vector<double> winding_;  // of the mesh alone
};

/// Upper bound of the distance from a triangle's points to the mesh.
class ReachBound {
 public:
  /// @param crack  where a cap is nearer to the mesh than this, all triangles within this distance are tried [m].
  ReachBound(const TriangleTree& tree, double crack) : tree_(tree), crack_(crack) {}

  double of(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    constexpr int kParts = 5;  // number of halvings
    return bound({a, b, c}, kParts);
  }

 private:
  using Corners = std::array<Vector3d, 3>;

  /// The distance from one triangle of the mesh is convex, so its largest value at the corners is a bound. For a sliver
  /// that bridges a crack, several triangles are equally near to its middle, and one of them is near to all of it.
  double boundByOne(const Corners& t, const Vector3d& center, double radius) {
    const TriangleTree::ClosestPoint nearest = tree_.closestPoint(center);
    least_ = nearest.distance;
    near_.assign(1, nearest.triangle);
    if (nearest.distance < crack_) tree_.trianglesWithin(center, crack_, near_);
    double best = nearest.distance + radius;
    for (const int triangle : near_) {
      double at_corners = 0.0;
      for (const Vector3d& p : t) at_corners = std::max(at_corners, tree_.distanceTo(triangle, p));
      best = std::min(best, at_corners);
    }
    return best;
  }

  double bound(const Corners& t, int depth) {
    const Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    double radius = 0.0;
    for (const Vector3d& p : t) radius = std::max(radius, (p - center).norm());
    const double whole = boundByOne(t, center, radius);
    if (depth == 0 || whole <= 2.0 * least_) return whole;
    // The parts of a triangle may be near to other triangles of the mesh.
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if ((t[(k + 1) % 3] - t[k]).squaredNorm() > (t[(longest + 1) % 3] - t[longest]).squaredNorm()) longest = k;
    }
    const Vector3d &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3], middle = 0.5 * (a + b);
    const double first = bound({a, middle, c}, depth - 1);
    return first >= whole ? whole : std::min(whole, std::max(first, bound({middle, b, c}, depth - 1)));
  }

  const TriangleTree& tree_;
  const double crack_;
  double least_ = 0.0;  // distance of the last triangle's centre
  std::vector<int> near_;
};

TriangleMesh withoutUnusedVertices(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<int, int> places;
  for (const Vector3i& t : mesh.triangles) {
    Vector3i corners;
    for (int k = 0; k < 3; ++k) {
      const auto [place, is_new] = places.try_emplace(t[k], static_cast<int>(result.vertices.size()));
      if (is_new) result.vertices.push_back(mesh.vertices[t[k]]);
      corners[k] = place->second;
    }
    result.triangles.push_back(corners);
  }
  return result;
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
  openings.caps = withoutUnusedVertices(openings.caps);
  ReachBound reach(check.tree(), kCrack * diagonal);
  for (const Vector3i& t : openings.caps.triangles) {
    checkCancelled();
    const std::vector<Vector3d>& v = openings.caps.vertices;
    openings.reach.push_back(reach.of(v[t[0]], v[t[1]], v[t[2]]));
  }
  return openings;
}

std::string summary(const Openings& openings) {
  std::ostringstream text;
  text.precision(3);
  if (openings.caps.triangles.empty()) return "no openings";
  text << openings.count << (openings.count == 1 ? " opening" : " openings");
  if (openings.count > 0)
    text << ", the longest " << openings.longest << " m around, " << openings.area << " m^2 of caps";
  if (openings.doubt > 0.0) text << ", doubtful in " << 100.0 * openings.doubt << " % of the interior";
  if (openings.voxels > 0) text << ", " << openings.voxels << " voxels treated as inside";
  return text.str();
}

}  // namespace sdf_ccd
