#include "closed_components.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "common/parallel_for.h"
#include "cut_test.h"
#include "measured_patch.h"
#include "sdf_ccd/common/cancel.h"
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
    const auto inward = std::count_if(closed_.begin(), closed_.end(), [&](auto i) { return components_[i].inward; });
    if (inward > 0) uniteClosed();
    if (inward == static_cast<std::ptrdiff_t>(closed_.size())) {
      all_flipped_ = true;
      for (const std::int32_t i : closed_) {
        result[i].flip = true;
        result[i].doubtful = closed_.size() > 1 && isHeld(i);
      }
    } else if (inward > 0) {
      decide(result);
    }
    if (closed_.size() > 1) doubtNested(result);
    if (closed_.size() > 1) findSolidWithin(result);
    for (const std::int32_t i : closed_) {
      checkCancelled();
      // Of two parts that meet in edges, only one may be inside out.
      doubt(result[i], result[i].flip && branches(extract(mesh_, patches_[i])));
      doubt(result[i], result[i].flip && isHeldByOpen(i));
      findLobes(i, result);
    }
    // This many sheets may enclose a volume.
    constexpr std::ptrdiff_t kFaces = 4;
    const bool encloses = std::count_if(components_.begin(), components_.end(),
                                        [](const MeasuredPatch& component) { return component.flat; }) >= kFaces;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      result[i].flat = components_[i].flat;
      doubt(result[i], components_[i].unmeasured || (components_[i].flat && encloses));
    }
    return result;
  }

 private:
  static void doubt(ClosedComponent& component, bool is_doubtful) {
    component.doubtful = component.doubtful || is_doubtful;
  }

  void decide(std::vector<ClosedComponent>& result) {
    all_flipped_ = isInsideOut();
    if (all_flipped_) {
      for (const std::int32_t i : closed_) result[i].flip = true;
    }
    std::vector<std::int32_t> inward;
    for (const std::int32_t i : closed_) {
      if (components_[i].inward != result[i].flip) inward.push_back(i);
    }
    // Patches that contain others come before them.
    std::stable_sort(inward.begin(), inward.end(), [&](std::int32_t a, std::int32_t b) {
      return components_[a].box.diagonal().squaredNorm() > components_[b].box.diagonal().squaredNorm();
    });
    for (const std::int32_t i : inward) {
      const std::set<std::int32_t> touched = touchedBy(patches_[i].triangles);
      long around = 0;
      bool in_touched = false;
      for (const std::int32_t holder : candidates(i)) {
        const long number = (result[holder].flip ? -1 : 1) * numberIn(holder, i);
        if (touched.count(holder) == 0)
          around += number;
        else
          in_touched = in_touched || number != 0;
      }
      if (around == 0) {
        result[i].flip = !result[i].flip;
        continue;
      }
      result[i].cavity = true;
      doubt(result[i], all_flipped_ || in_touched || around != 1 || isFlushInPart(i));
      for (const std::int32_t other : touched) doubt(result[i], result[other].cavity);
    }
  }

  /// Whether a patch within another one is a cavity or a solid follows from its orientation: if that of either patch is
  /// not certain, the inner one is doubtful.
  void doubtNested(std::vector<ClosedComponent>& result) {
    std::vector<char> uncertain(patches_.size(), 0);
    bool any = false;
    for (const std::int32_t i : closed_) {
      uncertain[i] = patches_[i].mixed || (result[i].flip && !all_flipped_);
      any = any || uncertain[i] != 0;
    }
    if (!any) return;
    uniteClosed();
    for (const std::int32_t i : closed_) {
      for (const std::int32_t holder : candidates(i)) {
        if (result[i].doubtful) break;
        doubt(result[i], (uncertain[i] != 0 || uncertain[holder] != 0) && isAtSolid(holder, i));
      }
    }
  }

  /// Finds a patch that is solid where others are already: if it was meant to be the wall of a cavity, it was drawn
  /// inside out.
  void findSolidWithin(std::vector<ClosedComponent>& result) {
    uniteClosed();
    for (const std::int32_t i : closed_) {
      const std::set<std::int32_t> holders = candidates(i);
      if (holders.empty() || result[i].cavity || components_[i].flat) continue;
      long around = 0;  // as in decide()
      for (const std::int32_t holder : holders) around += (result[holder].flip ? -1 : 1) * numberIn(holder, i);
      result[i].solid_within = around != 0 && touchedBy(patches_[i].triangles).empty();
      if (result[i].solid_within) return;
    }
  }

  void uniteClosed() {
    if (tree_) return;
    Patch all;
    for (std::size_t i = 0; i < label_.size(); ++i) {
      if (label_[i] >= 0) all.triangles.push_back(static_cast<std::int32_t>(i));
    }
    tree_ = std::make_unique<TriangleTree>(extract(mesh_, all));
    triangles_ = std::move(all.triangles);
  }

  /// Whether all patches that lie in no other one are inside out.
  bool isInsideOut() const {
    bool any = false;
    std::vector<std::int32_t> perhaps_held;  // by their witnesses, which may also lie in a patch that only overlaps
    for (const std::int32_t i : closed_) {
      const MeasuredPatch& component = components_[i];
      if (std::abs(tree_->windingNumber(component.behind) - component.own_number) > 0.5) {
        perhaps_held.push_back(i);
        continue;
      }
      if (!component.inward) return false;
      any = true;
    }
    for (const std::int32_t i : perhaps_held) {
      const bool inward = components_[i].inward;
      if ((inward && any) || isHeld(i)) continue;
      if (!inward) return false;
      any = true;
    }
    return any;
  }

  /// Whether the patch lies in another one, which it does not cut or touch.
  bool isHeld(std::int32_t inner) const {
    std::vector<std::int32_t> holders;
    for (const std::int32_t holder : candidates(inner)) {
      if (numberIn(holder, inner) != 0) holders.push_back(holder);
    }
    if (holders.empty()) return false;
    const std::set<std::int32_t> touched = touchedBy(patches_[inner].triangles);
    return std::any_of(holders.begin(), holders.end(), [&](auto holder) { return touched.count(holder) == 0; });
  }

  /// Whether an open patch may contain it.
  bool isHeldByOpen(std::int32_t inner) const {
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (!patches_[i].closed && components_[i].box.contains(components_[inner].box)) return true;
    }
    return false;
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

  /// Whether the witness lies inside another patch or on it, from either side: on it if the patches are flush.
  bool isAtSolid(std::int32_t holder, std::int32_t inner) const {
    const MeasuredPatch& component = components_[inner];
    const TriangleTree& tree = *components_[holder].tree;
    const Vector3d before = 2.0 * component.witness - component.behind;
    return numberIn(holder, inner) != 0 || std::lround(tree.windingNumber(before)) != 0 ||
           std::lround(tree.windingNumber(component.behind)) != 0;
  }

  /// Whether some faces of a cavity, but not all, lie on the patch that contains it, up to rounding: it may be a part
  /// that is flush there and was drawn inside out. (A hull of walls without thickness is near its cavity everywhere.)
  bool isFlushInPart(std::int32_t cavity) const {
    const std::set<std::int32_t> holders = candidates(cavity);
    bool flush = false, free = false;
    for (const std::int32_t triangle : patches_[cavity].triangles) {
      checkCancelled();
      const Vector3d center = centroid(cornersOf(mesh_, triangle));
      const bool here = std::any_of(holders.begin(), holders.end(), [&](std::int32_t holder) {
        return components_[holder].tree->closestPoint(center, rounding_).triangle >= 0;
      });
      (here ? flush : free) = true;
      if (flush && free) return true;
    }
    return false;
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

  void findLobes(std::int32_t i, std::vector<ClosedComponent>& result) {
    const MeasuredPatch& component = components_[i];
    const std::vector<std::int32_t>& lobe = component.inward ? component.facing_out : component.facing_in;
    result[i].negative_triangles = static_cast<int>(lobe.size());
    if (lobe.empty()) return;
    // Parts that meet in edges form one patch, and may cancel each other within it.
    const TriangleMesh part = extract(mesh_, patches_[i]);
    doubt(result[i], branches(part) || mayHidePockets(part, *component.tree));
    if (closed_.size() < 2) return;
    uniteClosed();
    // A triangle may belong to the lobe only in part.
    doubt(result[i], !touchedBy(patches_[i].triangles).empty());
    for (const std::int32_t other : closed_) {
      checkCancelled();
      if (result[i].doubtful) return;
      if (other == i) continue;
      const double number = component.tree->windingNumber(components_[other].witness);
      result[i].doubtful = (component.inward ? -number : number) < -0.5 || holds(other, lobe);
    }
  }

  /// Whether one of the triangles, none of which cuts the other patch, lies inside it.
  bool holds(std::int32_t patch, const std::vector<std::int32_t>& triangles) const {
    const MeasuredPatch& component = components_[patch];
    return std::any_of(triangles.begin(), triangles.end(), [&](std::int32_t triangle) {
      const Vector3d center = centroid(cornersOf(mesh_, triangle));
      return component.box.contains(center) && component.tree->inside(center, TriangleTree::Inside::kNotZero);
    });
  }

  const TriangleMesh& mesh_;
  const std::vector<Patch>& patches_;
  double eps_;                             ///< see cutTolerance()
  double rounding_;                        ///< [m]
  bool all_flipped_ = false;               ///< the whole file is inside out
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
