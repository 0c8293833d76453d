#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "binned_split.h"
#include "common/cancel_point.h"
#include "common/infinity.h"
#include "common/resize_in_steps.h"
#include "triangle_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sdf_ccd {
namespace {

constexpr int kLeafSize = 4;

}  // namespace

/// Top-down splits by the surface area heuristic over bins of the triangles' box centres (Wald 2007).
class TriangleTree::Builder {
 public:
  Builder(TriangleTree& tree, const TriangleMesh& mesh) : tree_(tree), mesh_(mesh) {}

  void build() {
    const int count = static_cast<int>(mesh_.triangles.size());
    resizeInSteps(boxes_, count);
    resizeInSteps(centers_, count);
    for (int i = 0; i < count; ++i) {
      checkNowAndThen(i);
      for (int corner = 0; corner < 3; ++corner) boxes_[i].extend(mesh_.vertices[mesh_.triangles[i][corner]]);
      centers_[i] = boxes_[i].center();
    }
    resizeInSteps(tree_.ids_, count);
    std::iota(tree_.ids_.begin(), tree_.ids_.end(), 0);
    tree_.nodes_.reserve(count);
    tree_.nodes_.emplace_back();
    ranges_.push_back({0, count, 0});
    for (std::size_t node = 0; node < tree_.nodes_.size(); ++node) divide(node);

    tree_.triangles_.reserve(count);
    for (const std::int32_t id : tree_.ids_) {
      checkNowAndThen(tree_.triangles_.size());
      tree_.triangles_.emplace_back(cornersOf(mesh_, id));
    }
    resizeInSteps(tree_.positions_, count);
    for (int i = 0; i < count; ++i) {
      checkNowAndThen(i);
      tree_.positions_[tree_.ids_[i]] = i;
    }
    resizeInSteps(tree_.expansions_, tree_.nodes_.size());
    resizeInSteps(cylinders_, tree_.nodes_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree_.nodes_.size(), 64), [this](const auto& range) {
      for (std::size_t node = range.begin(); node < range.end(); ++node) {
        cancel_.check();
        const Triangle* const begin = tree_.triangles_.data() + ranges_[node].begin;
        const Triangle* const end = tree_.triangles_.data() + ranges_[node].end;
        tree_.expansions_[node] = expand(begin, end);
        cylinders_[node] = cylinder(begin, end, tree_.expansions_[node]);
      }
    });
    buildQuads();
  }

 private:
  struct Range {
    std::int32_t begin, end;
    int depth;
  };

  /// Checks for cancellation every so often, in loops over all triangles, of which a mesh may have millions.
  void checkNowAndThen(std::size_t i) const {
    if (i % 4096 == 0) cancel_.check();
  }

  void divide(std::size_t index) {
    cancel_.check();
    const Range range = ranges_[index];
    AlignedBox3d box, centers;
    for (std::int32_t i = range.begin; i < range.end; ++i) {
      box.extend(boxes_[tree_.ids_[i]]);
      centers.extend(centers_[tree_.ids_[i]]);
    }
    tree_.nodes_[index].box = box;
    if (range.end - range.begin <= kLeafSize) {
      tree_.nodes_[index].first = range.begin;
      tree_.nodes_[index].count = range.end - range.begin;
      return;
    }
    const std::int32_t middle = split(range, centers);
    tree_.nodes_[index].first = static_cast<std::int32_t>(tree_.nodes_.size());
    tree_.nodes_[index].count = 0;
    for (const Range child : {Range{range.begin, middle, range.depth + 1}, Range{middle, range.end, range.depth + 1}}) {
      tree_.nodes_.emplace_back();
      ranges_.push_back(child);
    }
  }

  std::int32_t split(const Range& range, const AlignedBox3d& centers) {
    int axis;
    const double extent = centers.sizes().maxCoeff(&axis);
    std::int32_t* const begin = tree_.ids_.data() + range.begin;
    std::int32_t* const end = tree_.ids_.data() + range.end;
    std::int32_t* middle = begin + (end - begin) / 2;
    if (range.depth >= kHeuristicDepth || !(extent > 0)) return static_cast<std::int32_t>(middle - tree_.ids_.data());

    const double low = centers.min()[axis], scale = kBins / extent;
    const auto binOf = [&](std::int32_t id) {
      return std::min(kBins - 1, static_cast<int>((centers_[id][axis] - low) * scale));
    };
    Bins bins;
    for (const std::int32_t* id = begin; id != end; ++id) {
      const int bin = binOf(*id);
      bins.boxes[bin].extend(boxes_[*id]);
      ++bins.counts[bin];
    }
    const int best_bin = bins.bestSplit();
    if (best_bin > 0) middle = std::partition(begin, end, [&](std::int32_t id) { return binOf(id) < best_bin; });
    return static_cast<std::int32_t>(middle - tree_.ids_.data());
  }

  /// Around a node's triangles, with their mean normal as its axis.
  FlatCylinder cylinder(const Triangle* begin, const Triangle* end, const Expansion& expansion) const {
    FlatCylinder result{expansion.center, expansion.dipole.normalized()};
    for (const Triangle* t = begin; t != end; ++t) {
      checkNowAndThen(t - begin);
      for (const Vector3d& corner : t->corners()) result.extend(corner);
    }
    return result;
  }

  void buildQuads() {
    if (isLeaf(0)) return;
    std::vector<std::int32_t> parents = {0};            // of each quad
    tree_.quads_.reserve(tree_.nodes_.size() / 4 + 1);  // to copy large ones takes longer than a cancellation may
    for (std::size_t i = 0; i < parents.size(); ++i) {
      checkNowAndThen(i);
      Quad& quad = tree_.quads_.emplace_back();
      for (auto& lane : quad.low) lane.fill(kInfinity);
      int lane = 0;
      for (const std::int32_t node : below(parents[i])) {
        const FlatCylinder& cylinder = cylinders_[node];
        for (int k = 0; k < 3; ++k) {
          quad.low[k][lane] = tree_.nodes_[node].box.min()[k];
          quad.high[k][lane] = tree_.nodes_[node].box.max()[k];
          quad.center[k][lane] = cylinder.center[k];
          quad.axis[k][lane] = cylinder.axis[k];
        }
        quad.radius[lane] = cylinder.radius;
        quad.half_height[lane] = cylinder.half_height;
        quad.first[lane] = isLeaf(node) ? tree_.nodes_[node].first : static_cast<std::int32_t>(parents.size());
        quad.count[lane] = tree_.nodes_[node].count;
        if (!isLeaf(node)) parents.push_back(node);
        ++lane;
      }
    }
  }

  bool isLeaf(std::int32_t node) const { return tree_.nodes_[node].count > 0; }

  /// A node's children, the largest of them replaced by its own children: four nodes at most.
  std::vector<std::int32_t> below(std::int32_t node) const {
    std::vector<std::int32_t> found = {tree_.nodes_[node].first, tree_.nodes_[node].first + 1};
    while (found.size() < 4) {
      const auto size = [&](std::int32_t i) { return isLeaf(i) ? -1.0 : halfArea(tree_.nodes_[i].box); };
      const auto largest =
          std::max_element(found.begin(), found.end(), [&](auto a, auto b) { return size(a) < size(b); });
      if (isLeaf(*largest)) break;
      const std::int32_t first = tree_.nodes_[*largest].first;
      *largest = first;
      found.push_back(first + 1);
    }
    return found;
  }

  const CancelPoint cancel_;
  TriangleTree& tree_;
  const TriangleMesh& mesh_;
  std::vector<AlignedBox3d> boxes_;
  std::vector<Vector3d> centers_;
  std::vector<Range> ranges_;
  std::vector<FlatCylinder> cylinders_;  ///< of the nodes
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  validate(mesh);
  Builder(*this, mesh).build();
}

}  // namespace sdf_ccd
