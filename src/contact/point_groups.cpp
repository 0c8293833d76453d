#include "point_groups.h"

#include <algorithm>
#include <utility>

#include "common/cancel_point.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kFewPoints = 256;  // of a shell: not worth grouping
constexpr float kShareOfDepth = 0.25F;   // a group's radius over its depth
constexpr float kShareOfShell = 0.125F;  // over the shell's
constexpr std::int32_t kFewInNode = 4;   // points cost no more than their group
constexpr int kMostOpened = 256;         // nodes, in the search for the deepest point
constexpr double kSameDepth = 1e-6;      // relative difference that is not looked for

/// The path of a point along a chord, frame F.
struct PointPath {
  PointPath(const Chord& chord, const Vector3d& p_P)
      : start(chord.X_FP_start * p_P), end(chord.X_FP_end * p_P), middle(0.5 * (start + end)) {}

  double half() const { return (middle - start).norm(); }  // of its length [m]

  Vector3d start, end, middle;
};

/// Upper bound of the depth along a path [m], and where it is greatest of three places: depth is 1-Lipschitz.
std::pair<double, Vector3d> reachAlong(const DistanceField& field, const PointPath& path) {
  const double at_start = -field.lowerBound(path.start), at_middle = -field.lowerBound(path.middle),
               at_end = -field.lowerBound(path.end);
  const double reach = 0.5 * (at_middle + std::max(at_start, at_end) + path.half());
  const bool is_middle = at_middle >= std::max(at_start, at_end);
  return {std::max({reach, at_start, at_middle, at_end}), is_middle           ? path.middle
                                                          : at_start > at_end ? path.start
                                                                              : path.end};
}

/// The same for all points of a node: they stay as near to its centre as its radius.
double reachOf(const DistanceField& field, const Chord& chord, const SphereTree::Node& node) {
  return node.radius + reachAlong(field, PointPath(chord, node.center.cast<double>())).first;
}

}  // namespace

std::vector<NodeSum> nodeSums(const PointShell& shell, const SphereTree& tree) {
  std::vector<NodeSum> sums;
  if (shell.size() < kFewPoints || shell.areas.size() != shell.size()) return sums;
  sums.resize(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const SphereTree::Node& node = tree.nodes[i];
    NodeSum& sum = sums[i];
    Vector3d moment = Vector3d::Zero(), normal = Vector3d::Zero();
    double area = 0.0;
    const auto add = [&](double a, const Vector3f& at, const Vector3d& n) {
      area += a;
      moment += a * at.cast<double>();
      normal += a * n;
    };
    if (node.isLeaf()) {
      for (auto p = static_cast<std::size_t>(node.begin); p < static_cast<std::size_t>(node.end); ++p)
        add(double(shell.areas[p]), shell.offsets[p], shell.normal(p));
    } else {
      for (std::size_t k = 0; k < 2; ++k) {  // both come later
        const NodeSum& child = sums[static_cast<std::size_t>(node.first_child) + k];
        add(double(child.area), child.centroid, child.normal.cast<double>());
      }
    }
    sum.area = static_cast<float>(area);
    sum.centroid = area > 0.0 ? Vector3f((moment / area).cast<float>())
                              : Vector3f((node.center.cast<double>() - shell.origin).cast<float>());
    sum.normal = area > 0.0 ? Vector3f((normal / area).cast<float>()) : Vector3f(Vector3f::Zero());
  }
  return sums;
}

void PointGroups::divide(const DistanceField& field, const GroupedShell& shell, const ChordPath& path,
                         const ShellQueryResult& query, std::vector<ShellHit>& points) {
  groups_.clear();
  hits_.clear();
  points.clear();
  centroids_.origin = shell.shell.origin;
  centroids_.position_error = shell.shell.position_error;
  centroids_.offsets.clear();
  centroids_.normals.clear();
  centroids_.areas.clear();
  const std::vector<SphereTree::Node>& nodes = shell.tree.nodes;
  const float largest = kShareOfShell * nodes.front().radius;
  CancelTicks<> cancel;
  const auto addPoints = [&](std::int32_t begin, std::int32_t end, int chord) {
    for (std::int32_t i = begin; i < end; ++i) points.push_back({i, chord, {0.0, 1.0}});
  };
  const auto addGroup = [&](std::int32_t i, int chord) {
    const NodeSum& sum = shell.sums[static_cast<std::size_t>(i)];
    const float normal = sum.normal.norm();
    // Where the field has no direction, the points' normals have: their sum counts.
    const Vector3d middle =
        PointPath(path.chords[static_cast<std::size_t>(chord)], nodes[i].center.cast<double>()).middle;
    const bool has_direction = field.primitive() || field.interpolate(middle).gradient.squaredNorm() > 0.0;
    hits_.push_back({static_cast<int>(centroids_.offsets.size()), chord, {0.0, 1.0}});
    centroids_.offsets.push_back(sum.centroid);
    centroids_.normals.emplace_back(sum.normal.cast<double>());
    centroids_.areas.push_back(has_direction ? sum.area : normal * sum.area);
    groups_.push_back({i, chord, reachOf(field, path.chords[static_cast<std::size_t>(chord)], nodes[i])});
  };
  auto hit = query.hits.begin();
  for (const InsidePoints& inside : query.inside) {
    for (; hit != query.hits.end() && hit->chord < inside.chord; ++hit) points.push_back(*hit);
    if (inside.node < 0) {
      addPoints(inside.begin, inside.end, inside.chord);
      continue;
    }
    const Chord& chord = path.chords[static_cast<std::size_t>(inside.chord)];
    stack_.assign(1, inside.node);
    while (!stack_.empty()) {
      cancel.check();
      const std::int32_t i = stack_.back();
      const SphereTree::Node& node = nodes[i];
      stack_.pop_back();
      if (node.end - node.begin <= kFewInNode) {
        addPoints(node.begin, node.end, inside.chord);
        continue;
      }
      if (node.radius <= largest) {
        const PointPath center(chord, node.center.cast<double>());
        const double depth = -field.bounds(center.middle).high - center.half();
        if (node.radius <= kShareOfDepth * depth) {
          addGroup(i, inside.chord);
          continue;
        }
      }
      if (node.isLeaf()) {
        addPoints(node.begin, node.end, inside.chord);
      } else {
        stack_.push_back(node.first_child + 1);
        stack_.push_back(node.first_child);
      }
    }
  }
  points.insert(points.end(), hit, query.hits.end());
}

void PointGroups::findDeep(const DistanceField& field, const GroupedShell& shell, const ChordPath& path, double known,
                           std::vector<ShellHit>& points) {
  const std::vector<SphereTree::Node>& nodes = shell.tree.nodes;
  points.clear();
  open_.clear();
  double best = known;
  CancelTicks<> cancel;
  const auto chordOf = [&](const Open& open) -> const Chord& {
    return path.chords[static_cast<std::size_t>(groups_[static_cast<std::size_t>(open.group)].chord)];
  };
  const auto pathOf = [&](const Chord& chord, std::int32_t i) {
    return PointPath(chord, shell.shell.point(static_cast<std::size_t>(i)));
  };
  const auto isLess = [](const Open& a, const Open& b) { return a.reach < b.reach; };
  const auto isDone = [&](double reach) { return reach <= best + std::max(field.errorBound(), kSameDepth * best); };
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    cancel.check();
    Group& group = groups_[g];
    const std::int32_t first = nodes[static_cast<std::size_t>(group.node)].begin;
    points.push_back({first, group.chord, {0.0, 1.0}});
    open_.push_back({group.reach, group.node, static_cast<int>(g)});
    best = std::max(best, -field.interpolate(pathOf(chordOf(open_.back()), first).middle).value);
    group.reach = 0.0;
  }
  std::make_heap(open_.begin(), open_.end(), isLess);
  const auto close = [&](const Open& open) {
    Group& group = groups_[static_cast<std::size_t>(open.group)];
    group.reach = std::max(group.reach, open.reach);
  };
  for (int opened = 0; !open_.empty() && opened < kMostOpened && !isDone(open_.front().reach); ++opened) {
    cancel.check();
    std::pop_heap(open_.begin(), open_.end(), isLess);
    const Open next = open_.back();
    open_.pop_back();
    const Chord& chord = chordOf(next);
    const SphereTree::Node& node = nodes[static_cast<std::size_t>(next.node)];
    if (node.isLeaf()) {
      double depth = best, reach = 0.0;
      std::int32_t deepest = -1;
      for (std::int32_t i = node.begin; i < node.end; ++i) {
        const auto [reach_of_point, at] = reachAlong(field, pathOf(chord, i));
        reach = std::max(reach, reach_of_point);
        const double of_point = reach_of_point > depth ? -field.interpolate(at).value : 0.0;
        if (of_point > depth) deepest = i;
        depth = std::max(depth, of_point);
      }
      if (deepest >= 0) points.push_back({deepest, groups_[static_cast<std::size_t>(next.group)].chord, {0.0, 1.0}});
      best = depth;
      close({std::min(next.reach, reach), next.node, next.group});
      continue;
    }
    for (int k = 0; k < 2; ++k) {
      const std::int32_t child = node.first_child + k;
      open_.push_back(
          {std::min(next.reach, reachOf(field, chord, nodes[static_cast<std::size_t>(child)])), child, next.group});
      std::push_heap(open_.begin(), open_.end(), isLess);
    }
  }
  for (const Open& open : open_) close(open);
}

}  // namespace sdf_ccd
