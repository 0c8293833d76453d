#include "closed_components.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "cut_test.h"
#include "measured_patch.h"
#include "self_crossing.h"

namespace sdf_ccd {
namespace {

constexpr double kRounding = 1e-6;  // of coordinates stored as floats, relative to the mesh's size

/// Decides about all patches of a mesh together.
class Inspection {
 public:
  Inspection(const TriangleMesh& mesh, const std::vector<Patch>& patches)
      : mesh_(mesh),
        patches_(patches),
        eps_(cutTolerance(mesh)),
        rounding_(kRounding * boundingBox(mesh).sizes().maxCoeff()) {
    components_.resize(patches.size());
    label_.assign(mesh.triangles.size(), -1);
    parallelFor(std::size_t{0}, patches.size(),
                [&](std::size_t i) { components_[i] = measurePatch(mesh, patches[i]); });
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (!components_[i].tree) continue;
      closed_.push_back(static_cast<std::int32_t>(i));
      for (const std::int32_t triangle : patches[i].triangles) label_[triangle] = closed_.back();
    }
  }

  std::vector<ClosedComponent> run() {
    std::vector<ClosedComponent> result(patches_.size());
    if (std::any_of(closed_.begin(), closed_.end(), [&](auto i) { return components_[i].inward; })) decide(result);
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      checkCancelled();
      result[i].negative_triangles = components_[i].negative_triangles;
      doubt(result[i], patches_[i].closed && !components_[i].tree);
      doubt(result[i], (result[i].flip || result[i].negative_triangles > 0) && mayCancel(i));
    }
    return result;
  }

 private:
  static void doubt(ClosedComponent& component, bool is_doubtful) {
    component.doubtful = component.doubtful || is_doubtful;
  }

  void decide(std::vector<ClosedComponent>& result) {
    uniteClosed();
    // The whole file is inside out if all patches that lie in no other one are.
    const bool flip_all =
        std::all_of(closed_.begin(), closed_.end(), [&](auto i) { return components_[i].inward || isHeld(i); });
    for (const std::int32_t i : closed_) result[i].flip = flip_all;
    std::vector<std::int32_t> inward;
    for (const std::int32_t i : closed_) {
      if (components_[i].inward != result[i].flip) inward.push_back(i);
    }
    // Patches that contain others come before them.
    std::stable_sort(inward.begin(), inward.end(), [&](std::int32_t a, std::int32_t b) {
      return components_[a].box.diagonal().squaredNorm() > components_[b].box.diagonal().squaredNorm();
    });
    for (const std::int32_t i : inward) {
      const std::set<std::int32_t> touched = touchedBy(patches_[i].triangles), holders = candidates(i);
      long around = 0;
      for (const std::int32_t holder : holders) {
        if (touched.count(holder) == 0) around += (result[holder].flip ? -1 : 1) * numberIn(holder, i);
      }
      if (around == 0) {
        result[i].flip = !result[i].flip;
        continue;
      }
      result[i].cavity = true;
      doubt(result[i], around != 1 || !touched.empty() || isFlush(i, holders));
    }
  }

  /// Whether winding numbers may cancel each other where they should not, if a patch is flipped or has a lobe: those of
  /// two patches, of two parts that meet in edges, or of a lobe and the part that overlaps it.
  bool mayCancel(std::size_t i) const {
    if (patches_.size() > 1) return true;
    const TriangleMesh part = extract(mesh_, patches_[i]);
    return branches(part) || (components_[i].negative_triangles > 0 && mayHidePockets(part, *components_[i].tree));
  }

  void uniteClosed() {
    Patch all;
    for (std::size_t i = 0; i < label_.size(); ++i) {
      if (label_[i] >= 0) all.triangles.push_back(static_cast<std::int32_t>(i));
    }
    tree_ = std::make_unique<TriangleTree>(extract(mesh_, all));
    triangles_ = std::move(all.triangles);
  }

  /// Whether the patch lies in another one, which it does not cut or touch.
  bool isHeld(std::int32_t inner) const {
    const std::set<std::int32_t> touched = touchedBy(patches_[inner].triangles), holders = candidates(inner);
    return std::any_of(holders.begin(), holders.end(),
                       [&](auto holder) { return touched.count(holder) == 0 && numberIn(holder, inner) != 0; });
  }

  /// A patch's winding number at the witness of another one. If they touch there, it is evaluated just behind the
  /// witness; not always, because a wall between them may be thinner than that distance.
  long numberIn(std::int32_t holder, std::int32_t inner) const {
    checkCancelled();
    constexpr double kWhole = 0.25;
    const TriangleTree& tree = *components_[holder].tree;
    const double at = tree.windingNumber(components_[inner].witness), whole = std::round(at);
    return std::lround(std::abs(at - whole) < kWhole ? whole : tree.windingNumber(components_[inner].behind));
  }

  /// Whether faces of a cavity lie on a patch that contains it, up to rounding: it may be a part that is flush there
  /// and was drawn inside out.
  bool isFlush(std::int32_t cavity, const std::set<std::int32_t>& holders) const {
    return std::any_of(patches_[cavity].triangles.begin(), patches_[cavity].triangles.end(), [&](auto triangle) {
      checkCancelled();
      const Vector3d center = centroid(cornersOf(mesh_, triangle));
      return std::any_of(holders.begin(), holders.end(), [&](std::int32_t holder) {
        return components_[holder].tree->closestPoint(center, rounding_).triangle >= 0;
      });
    });
  }

  /// Patches whose box contains this one's, up to rounding, and that a ray from its witness along x may cross;
  /// ascending.
  std::set<std::int32_t> candidates(std::int32_t inner) const {
    checkCancelled();
    const MeasuredPatch& component = components_[inner];
    std::set<std::int32_t> found;
    const Vector3d rounding = Vector3d::Constant(rounding_);
    const AlignedBox3d box(component.box.min() + rounding, component.box.max() - rounding);
    tree_->forEachTriangle(
        [&](const Vector3d& center, double radius) {
          const Vector3d r = center - component.witness;
          return r.x() >= -radius && r.y() * r.y() + r.z() * r.z() <= radius * radius * (1.0 + 1e-9);
        },
        [&](int triangle) {
          const std::int32_t other = label_[triangles_[triangle]];
          if (other != inner && components_[other].box.contains(box)) found.insert(other);
        });
    return found;
  }

  /// Other closed patches that the given triangles of one patch cut or touch.
  std::set<std::int32_t> touchedBy(const std::vector<std::int32_t>& triangles) const {
    std::set<std::int32_t> found;
    std::vector<int> near;
    for (const std::int32_t triangle : triangles) {
      checkCancelled();
      tree_->trianglesNear(cornersOf(mesh_, triangle), eps_, near);
      for (const int i : near) {
        const std::int32_t other = triangles_[i];
        if (label_[other] == label_[triangle] || found.count(label_[other]) != 0) continue;
        if (cut(mesh_, triangle, other, eps_)) found.insert(label_[other]);
      }
    }
    return found;
  }

  const TriangleMesh& mesh_;
  const std::vector<Patch>& patches_;
  double eps_;                             ///< see cutTolerance()
  double rounding_;                        ///< [m]
  std::vector<MeasuredPatch> components_;  ///< per patch
  std::vector<std::int32_t> label_;        ///< of each triangle: its closed patch, or -1
  std::vector<std::int32_t> closed_;       ///< indices of the closed patches
  std::unique_ptr<TriangleTree> tree_;     ///< of all closed patches
  std::vector<std::int32_t> triangles_;    ///< of the mesh, in the order of tree_'s triangles
};

}  // namespace

std::vector<ClosedComponent> inspectClosed(const TriangleMesh& mesh, const std::vector<Patch>& patches) {
  return Inspection(mesh, patches).run();
}

}  // namespace sdf_ccd
