#include "open_components.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "common/pi.h"
#include "mesh/triangle_tree.h"

namespace sdf_ccd {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): one sequence per seed, with a state of a single number.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : state_(seed * 0xD1342543DE82EF95ULL + 1) {}

  /// In [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }

 private:
  std::uint64_t state_;
};

/// Counts of what rays from an open patch met, the patch in the orientation in which it is drawn.
struct Votes {
  int rays = 0;                      ///< from both sides
  int escape = 0;                    ///< rays from the front that left the mesh, minus those from the back
  std::map<std::int32_t, int> same;  ///< per other patch: rays from front to front or from back to back, minus those
                                     ///< between a front and a back
};

class Caster {
 public:
  Caster(const TriangleMesh& mesh, const std::vector<Patch>& patches)
      : mesh_(mesh), patches_(patches), tree_(mesh), area_(2.0 * surfaceArea(mesh)), label_(mesh.triangles.size(), -1) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (const std::int32_t triangle : patches[i].triangles) label_[triangle] = static_cast<std::int32_t>(i);
    }
  }

  /// Whether the patch, as it is drawn, bounds a solid: the winding number in front of it is an integer, 0 or more.
  bool boundsSolid(std::int32_t patch, int points) const {
    checkCancelled();
    constexpr double kBefore = 1e-7, kWhole = 0.05;  // [m]; of the number: cracks of closed meshes change it by less
    const std::vector<std::int32_t>& triangles = patches_[patch].triangles;
    Sequence random(static_cast<std::uint64_t>(patch));
    for (int i = 0; i < points; ++i) {
      const std::int32_t triangle = triangles[(triangles.size() - 1) * i / points];
      const Vector3d normal = areaNormal(mesh_, triangle).normalized();
      if (!normal.allFinite() || normal.isZero()) continue;
      const double winding = tree_.windingNumber(pointOn(triangle, random) + kBefore * normal);
      const double whole = std::round(winding);
      if (!(std::abs(winding - whole) <= kWhole && whole >= 0.0)) return false;
    }
    return true;
  }

  /// Casts rays from both sides, at points spread evenly over the area; none if the patch, one of `patches`, is so
  /// small that its share of all rays would show nothing.
  Votes cast(std::int32_t patch, std::size_t patches) const {
    constexpr double kRays = 1 << 17;
    Votes votes;
    const std::vector<std::int32_t>& triangles = patches_[patch].triangles;
    std::vector<double> area_up_to;
    double area = 0.0;
    for (const std::int32_t triangle : triangles) area_up_to.push_back(area += areaNormal(mesh_, triangle).norm());
    const double share = std::max(area / area_, 1.0 / static_cast<double>(patches));
    const int count = static_cast<int>(std::min(512.0, kRays * share));
    if (!(area > 0.0) || count < 4) return votes;
    Sequence random(static_cast<std::uint64_t>(patch));
    for (int i = 0; i < count; ++i) {
      const double at = area * (i + random.next()) / count;
      const auto chosen = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, at);
      const std::int32_t triangle = triangles[chosen - area_up_to.begin()];
      const Vector3d normal = areaNormal(mesh_, triangle).normalized();
      if (!normal.allFinite() || normal.isZero()) continue;
      const Vector3d p = pointOn(triangle, random);
      const Vector3d direction = aboutNormal(normal, random);
      for (const int side : {1, -1}) countRay(patch, side, p, side * direction, votes);
    }
    return votes;
  }

 private:
  Vector3d pointOn(std::int32_t triangle, Sequence& random) const {
    const Vector3i& t = mesh_.triangles[triangle];
    const double u = std::sqrt(random.next()), v = random.next();
    return (1.0 - u) * mesh_.vertices[t[0]] + u * (1.0 - v) * mesh_.vertices[t[1]] + u * v * mesh_.vertices[t[2]];
  }

  /// A random direction, distributed by the cosine to the normal.
  static Vector3d aboutNormal(const Vector3d& normal, Sequence& random) {
    const double radius = std::sqrt(random.next()), angle = 2.0 * kPi * random.next();
    const Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
    const double up = std::sqrt(std::max(1e-6, 1.0 - radius * radius));
    return (radius * std::cos(angle) * x + radius * std::sin(angle) * y + up * normal).normalized();
  }

  /// @param side  1 for the front, -1 for the back.
  void countRay(std::int32_t patch, int side, const Vector3d& p, const Vector3d& direction, Votes& votes) const {
    constexpr double kOnSurface = 1e-9;
    ++votes.rays;
    const int met = tree_.firstHit(p, direction, kOnSurface);
    if (met < 0) {
      votes.escape += side;
      return;
    }
    const std::int32_t other = label_[met];
    if (other < 0 || other == patch) return;
    const double facing = direction.dot(areaNormal(mesh_, met));
    if (facing != 0.0) votes.same[other] += (facing < 0.0) == (side > 0) ? 1 : -1;
  }

  const TriangleMesh& mesh_;
  const std::vector<Patch>& patches_;
  TriangleTree tree_;
  double area_;                      ///< of all triangles, twice
  std::vector<std::int32_t> label_;  ///< of each triangle: its patch
};

}  // namespace

std::vector<char> openPatchesToFlip(const TriangleMesh& mesh, const std::vector<Patch>& patches) {
  constexpr int kSweeps = 16;
  constexpr std::size_t kManyPatches = 4096;
  std::vector<char> flipped(patches.size(), 0);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].closed) open.push_back(static_cast<std::int32_t>(i));
  }
  if (open.empty()) return flipped;

  const Caster caster(mesh, patches);
  // If solids overlap, part of a face is visible from outside, and another part from inside the other solid, so rays
  // can be misleading. Winding numbers are reliable where they are integers.
  const int points = open.size() > kManyPatches ? 1 : 8;
  if (std::all_of(open.begin(), open.end(), [&](std::int32_t i) { return caster.boundsSolid(i, points); }))
    return flipped;
  std::vector<Votes> votes(patches.size());
  parallelFor(std::size_t{0}, open.size(), [&](std::size_t i) { votes[open[i]] = caster.cast(open[i], open.size()); });

  // First the patches that are seen from outside are decided, then those that are seen from these.
  std::stable_sort(open.begin(), open.end(), [&](std::int32_t a, std::int32_t b) {
    return std::int64_t{std::abs(votes[a].escape)} * votes[b].rays >
           std::int64_t{std::abs(votes[b].escape)} * votes[a].rays;
  });
  std::vector<char> decided(patches.size(), 0);
  for (std::size_t i = 0; i < patches.size(); ++i) decided[i] = patches[i].closed;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool changed = false;
    for (const std::int32_t patch : open) {
      int front = votes[patch].escape;
      for (const auto& [other, same] : votes[patch].same) {
        if (decided[other]) front += flipped[other] ? -same : same;
      }
      if (votes[patch].rays == 0) continue;
      const bool clear = 20 * std::abs(front) > votes[patch].rays;
      if (!clear && sweep == 0) continue;  // until more is known of the others
      const char flips = clear ? front < 0 : flipped[patch];
      changed = changed || flips != flipped[patch] || !decided[patch];
      flipped[patch] = flips;
      decided[patch] = 1;
    }
    if (!changed && sweep > 0) break;
  }
  return flipped;
}

}  // namespace sdf_ccd
