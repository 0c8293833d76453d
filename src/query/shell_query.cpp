#include "shell_query.h"

#include <algorithm>

#include "common/cancel_point.h"
#include "prefetch.h"
#include "query/swept_side.h"
#include "representation_queries.h"
#include "shell/point_shell.h"
#include "shell_points.h"
#include "sphere_sides.h"

namespace sdf_ccd {
namespace {

/// Points [begin, end) of the shell: those of a node, or some of them.
struct PointRange {
  std::int32_t begin, end;
};

/// Memory of a search, kept by each thread so that steady-state queries allocate nothing.
struct SearchWork {
  std::vector<std::int32_t> stack;   ///< nodes still to visit
  std::vector<std::int32_t> tested;  ///< nodes that are tested together
  std::vector<PointRange> pending;   ///< points still to be queried
  std::vector<PointRange> sorted;    ///< points that are tested together as spheres
};

SearchWork& searchWork() {
  thread_local SearchWork work;
  work.stack.clear();
  return work;
}

/// Tests a shell against a field, chord by chord.
class ShellSearch {
 public:
  ShellSearch(const DistanceField& field, const PointShell& shell, const SphereTree& tree, ShellQueryResult& result)
      : shell_(shell),
        nodes_(tree.nodes.data()),
        result_(result),
        work_(searchWork()),
        // A point's roots are those of the interpolated field; the spheres' test is about the true distance.
        sides_(field, field.errorBound(), tree.nodes[0].ball()),
        points_(field, shell, result) {}

  void follow(const Chord& chord, int index) {
    cancel_.check();
    index_ = index;
    sides_.begin(chord);
    points_.begin(chord, index);
    work_.stack.assign(1, 0);
    work_.pending.clear();
    testNode();  // enough for bodies that are far apart
    while (!work_.stack.empty()) {
      cancel_.check();
      sides_.inVectors() ? testNodes() : testNode();
    }
    while (!work_.pending.empty()) {
      cancel_.check();
      sides_.sortsPoints() ? sortPoints() : queryPoints();
    }
    points_.finish();
  }

 private:
  void testNode() {
    const std::int32_t i = work_.stack.back();
    work_.stack.pop_back();
    const BoundingBall ball = nodes_[i].ball();
    visit(i, sides_.of(ball.center, ball.radius));
  }

  /// Tests the topmost nodes of the stack together.
  void testNodes() {
    std::vector<std::int32_t>&stack = work_.stack, &tested = work_.tested;
    const std::size_t count = std::min<std::size_t>(stack.size(), SphereGroup::kCapacity);
    tested.assign(stack.end() - count, stack.end());
    stack.resize(stack.size() - count);
    SphereGroup& group = sides_.group();
    group.size = 0;
    for (const std::int32_t i : tested) group.add(nodes_[i].center, nodes_[i].radius);
    sides_.testGroup();
    for (std::size_t i = 0; i < count; ++i) visit(tested[i], group.sideOf(static_cast<int>(i)));
  }

  void visit(std::int32_t i, SweptSide side) {
    const SphereTree::Node& node = nodes_[i];
    if (side == SweptSide::kOutside || node.begin == node.end) return;
    if (side == SweptSide::kInside) return addInside(node.begin, node.end, i);
    if (node.isLeaf()) {
      work_.pending.push_back({node.begin, node.end});
      // A shell may be larger than the caches.
      prefetch(shell_.offsets.data() + node.begin, static_cast<std::size_t>(node.end - node.begin));
    } else {
      divide(node);
    }
  }

  /// Pushes descendants of a node onto the stack: as many as fill a vector, if spheres are tested in vectors.
  void divide(const SphereTree::Node& node) {
    constexpr int kLevels = 3;
    const SphereTree::Node *first = nodes_ + node.first_child, *last = first + 2;
    for (int level = 1; level < kLevels && sides_.inVectors(); ++level) {
      if (std::any_of(first, last, [](const SphereTree::Node& below) { return below.isLeaf(); })) break;
      last = nodes_ + last[-1].first_child + 2;
      first = nodes_ + first->first_child;
    }
    prefetch(first, static_cast<std::size_t>(last - first));
    for (; last != first; --last) work_.stack.push_back(static_cast<std::int32_t>(last - nodes_) - 1);
  }

  void addInside(std::int32_t begin, std::int32_t end, std::int32_t node = -1) {
    result_.inside.push_back({begin, end, index_, node});
  }

  /// Queries the points of one range.
  void queryPoints() {
    const PointRange range = work_.pending.back();
    work_.pending.pop_back();
    for (std::int32_t p = range.begin; p < range.end; ++p) points_.query(p);
  }

  /// Tests points of several ranges as spheres of radius zero first, to query only those near the surface.
  void sortPoints() {
    SphereGroup& group = sides_.group();
    group.size = 0;
    std::vector<PointRange>&pending = work_.pending, &sorted = work_.sorted;
    sorted.clear();
    while (!pending.empty() && group.size < SphereGroup::kCapacity) {
      PointRange& last = pending.back();
      const PointRange some{last.begin, std::min(last.end, last.begin + SphereGroup::kCapacity - group.size)};
      sorted.push_back(some);
      for (std::int32_t p = some.begin; p < some.end; ++p) group.add(shell_.point(static_cast<std::size_t>(p)), 0.0);
      last.begin = some.end;
      if (last.begin == last.end) pending.pop_back();
    }
    sides_.testGroup();
    int i = 0;
    for (const PointRange& range : sorted) {
      for (std::int32_t p = range.begin; p < range.end; ++p, ++i) {
        const SweptSide side = group.sideOf(i);
        if (side == SweptSide::kUnknown) points_.query(p);
        if (side == SweptSide::kInside) addInside(p, p + 1);
      }
    }
  }

  const PointShell& shell_;
  const SphereTree::Node* nodes_;
  ShellQueryResult& result_;
  SearchWork& work_;
  SphereSides sides_;
  ShellPoints points_;
  CancelTicks<> cancel_;
  int index_ = 0;
};

}  // namespace

long ShellQueryResult::count() const {
  long count = static_cast<long>(hits.size());
  for (const InsidePoints& points : inside) count += points.end - points.begin;
  return count;
}

void listHits(const ShellQueryResult& result, std::vector<ShellHit>& hits) {
  hits.clear();
  auto hit = result.hits.begin();
  for (const InsidePoints& points : result.inside) {
    for (; hit != result.hits.end() && hit->chord < points.chord; ++hit) hits.push_back(*hit);
    for (int i = points.begin; i < points.end; ++i) hits.push_back({i, points.chord, {0.0, 1.0}});
  }
  hits.insert(hits.end(), hit, result.hits.end());
}

void shellIntervals(const DistanceField& field, const PointShell& shell, const SphereTree& tree, const ChordPath& path,
                    ShellQueryResult& result) {
  result.hits.clear();
  result.inside.clear();
  result.points_tested = 0;
  if (tree.nodes.empty()) return;
  ShellSearch search(field, shell, tree, result);
  for (std::size_t c = 0; c < path.chords.size(); ++c) search.follow(path.chords[c], static_cast<int>(c));
}

}  // namespace sdf_ccd
