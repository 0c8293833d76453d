#include "plane_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/cancel_point.h"
#include "common/infinity.h"

namespace sdf_ccd {
namespace {

constexpr double kFiner = 0.02;  // of the resolution: accuracy of heights, and of chords in a short search
constexpr double kNoTarget = kInfinity;
constexpr int kShortSearch = 64;  // poses
constexpr double kOpen = 0.4;     // of the lowest known height above a target: boxes lower by more are opened

using Heights = std::array<double, BoxTree::Node::kWidth>;

/// Heights of points of the surface at one pose.
struct Upward {
  Upward(const HalfSpace& half_space, const Isometry3d& X_FP)
      : direction(X_FP.linear().transpose() * half_space.normal),
        offset(half_space.normal.dot(X_FP.translation()) - half_space.offset) {}

  double heightOf(const Vector3d& p_P) const { return direction.dot(p_P) + offset; }

  Vector3d direction;
  double offset;
};

const Vector3d& lowestCorner(const Corners& t, const Vector3d& up) {
  const double a = up.dot(t[0]), b = up.dot(t[1]), c = up.dot(t[2]);
  return a <= b ? (a <= c ? t[0] : t[2]) : (b <= c ? t[1] : t[2]);
}

/// Lower bounds of the heights of a node's boxes. In double precision, so that boxes that lie flat on a plane are known
/// to.
Heights boxHeights(const BoxTree::Node& node, const Upward& up, double origin_height) {
  constexpr int kWidth = BoxTree::Node::kWidth;
  Heights heights;
  for (int i = 0; i < kWidth; ++i)
    heights[i] = origin_height + up.direction[0] * double(node.center[0][i]) +
                 up.direction[1] * double(node.center[1][i]) + up.direction[2] * double(node.center[2][i]) -
                 double(node.radius[i]);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < kWidth; ++i)
      heights[i] -=
          std::abs(up.direction[0] * double(node.axis[axis][0][i]) + up.direction[1] * double(node.axis[axis][1][i]) +
                   up.direction[2] * double(node.axis[axis][2][i])) *
          double(node.half[axis][i]);
  return heights;
}

/// A surface's lowest triangle at one pose.
struct LowestTriangle {
  int triangle = -1;
  double height = kInfinity;    // [m]
  double at_least = kInfinity;  // lower bound of all heights [m]
};

/// Its lowest point, frame F.
Vector3d pointOf(const LowestTriangle& lowest, const BoxTree& surface, const Upward& up, const HalfSpace& half_space,
                 const Isometry3d& X_FP) {
  const RoundedTriangle& t = surface.triangle(lowest.triangle);
  return X_FP * lowestCorner(t.corners, up.direction) - t.radius * half_space.normal;
}

/// Branch and bound over the boxes.
class LowestSearch {
 public:
  /// @param target    heights well above it need not be accurate: `at_least` is then above it too.
  /// @param accuracy  of others; see lowestPoint().
  LowestSearch(const BoxTree& surface, const Upward& up, double target, double accuracy, SeparationMemory& memory)
      : surface_(surface), up_(up), target_(target), accuracy_(accuracy), memory_(memory) {}

  LowestTriangle run(int first_triangle) {
    constexpr int kMany = 256;
    constexpr double kBoxRoundings = 1e-6;  // of the radius: boxes of single precision are larger by less than that
    if (first_triangle >= 0) test(first_triangle);
    auto& pending = memory_.high_boxes;
    pending.assign(1, {-kInfinity, surface_.root().node});
    const double origin_height = up_.heightOf(surface_.origin());
    for (int opened = 0; !pending.empty(); ++opened) {
      cancel_.check();
      if (opened == kMany) {
        accuracy_ = std::max(accuracy_, kBoxRoundings * surface_.ball().radius);
        if (found_.triangle >= 0) setCut();
      }
      const SeparationMemory::HighBox next = pending.back();
      pending.pop_back();
      if (next.height < cut_) {
        open(surface_.node(next.node), origin_height);
      } else {
        found_.at_least = std::min(found_.at_least, next.height);
      }
    }
    found_.at_least = std::min(found_.at_least, found_.height);
    return found_;
  }

 private:
  void test(int i) {
    const RoundedTriangle& t = surface_.triangle(i);
    const double height = up_.heightOf(lowestCorner(t.corners, up_.direction)) - t.radius;
    if (!(height < found_.height)) return;
    found_.height = height;
    found_.triangle = i;
    setCut();
  }

  void setCut() { cut_ = found_.height - std::max(accuracy_, kOpen * (found_.height - target_)); }

  /// The lowest box below is opened next.
  void open(const BoxTree::Node& node, double origin_height) {
    const Heights heights = boxHeights(node, up_, origin_height);
    auto& pending = memory_.high_boxes;
    const std::size_t first = pending.size();
    for (int i = 0; i < node.count; ++i) {
      const std::int32_t below = node.below[i];
      if (!(heights[i] < cut_)) {
        found_.at_least = std::min(found_.at_least, heights[i]);
      } else if (BoxTree::isTriangle(below)) {
        test(BoxTree::triangleOf(below));
      } else {
        pending.push_back({heights[i], below});
      }
    }
    for (std::size_t i = first; i + 1 < pending.size(); ++i)
      if (pending[i].height < pending.back().height) std::swap(pending[i], pending.back());
  }

  const BoxTree& surface_;
  const Upward& up_;
  const double target_;
  double accuracy_;
  SeparationMemory& memory_;
  double cut_ = kInfinity;  // boxes higher than this are not opened
  LowestTriangle found_;
  CancelTicks<256> cancel_;
};

class PlaneQuery {
 public:
  PlaneQuery(const HalfSpace& half_space, const BoxTree& surface, const TwoBodyMotion& motion,
             const SeparationOptions& options, SeparationWitness& witness, SeparationMemory& memory)
      : half_space_(half_space),
        surface_(surface),
        motion_(motion),
        options_(options),
        witness_(witness),
        memory_(memory) {}

  Separation run() {
    const Isometry3d X_start = motion_.X_FP(0.0), X_end = motion_.X_FP(1.0);
    rounding_ = heightRounding(half_space_, surface_, {X_start, X_end});
    found_.distance = kInfinity;
    const Low at_end = lowestAt(1.0, X_end, 1.0);
    if (!crossed_) testBetween({0.0, 1.0, lowestAt(0.0, X_start, 1.0), at_end});
    if (!crossed_) found_.state = open_ ? SeparationState::kOpen : SeparationState::kApart;
    return found_;
  }

 private:
  /// The lowest height at one time.
  struct Low {
    double at_least, looseness;  // the height itself is higher than its lower bound by no more than the looseness [m]
  };

  /// Part of the motion.
  struct Part {
    double start, end;
    Low at_start, at_end;
  };

  double chordError(double length) const { return motion_.acceleration * length * length / 8.0; }

  /// Tests one pose. @param length  of the interval that it ends.
  Low lowestAt(double s, const Isometry3d& X_FP, double length) {
    ++found_.tests;
    const Upward up(half_space_, X_FP);
    const double target = options_.margin + chordError(length) + rounding_;
    LowestSearch search(surface_, up, target, kFiner * options_.resolution, memory_);
    const LowestTriangle lowest = search.run(witness_.near_b);
    witness_.near_b = lowest.triangle;
    if (lowest.height + rounding_ < -options_.margin) setCrossing(s, X_FP, up, lowest);
    return {lowest.at_least, lowest.height - lowest.at_least};
  }

  void setCrossing(double s, const Isometry3d& X_FP, const Upward& up, const LowestTriangle& lowest) {
    crossed_ = true;
    found_.state = SeparationState::kCrossing;
    found_.s = s;
    found_.p_A = pointOf(lowest, surface_, up, half_space_, X_FP);
    found_.normal_A = half_space_.normal;
  }

  void testBetween(const Part& part) {
    if (crossed_) return;
    const double length = part.end - part.start, error = chordError(length);
    const Low& lower = part.at_start.at_least < part.at_end.at_least ? part.at_start : part.at_end;
    const double apart = lower.at_least - error - rounding_;
    if (apart > options_.margin) {
      found_.distance = std::min(found_.distance, apart);
      return;
    }
    const bool is_short = !open_ && found_.tests < kShortSearch;
    if (error <= (is_short ? kFiner : 1.0) * options_.resolution || found_.tests > options_.max_tests) {
      const double within = error + lower.looseness + 2.0 * rounding_;
      found_.open_within = open_ ? std::max(found_.open_within, within) : within;
      open_ = true;
      return;
    }
    const double middle = 0.5 * (part.start + part.end);
    const Low at_middle = lowestAt(middle, motion_.X_FP(middle), 0.5 * length);
    testBetween({middle, part.end, at_middle, part.at_end});  // what touches at its end usually touches later too
    testBetween({part.start, middle, part.at_start, at_middle});
  }

  const HalfSpace& half_space_;
  const BoxTree& surface_;
  const TwoBodyMotion& motion_;
  const SeparationOptions& options_;
  SeparationWitness& witness_;
  SeparationMemory& memory_;
  double rounding_ = 0.0;
  bool crossed_ = false, open_ = false;
  Separation found_;
};

}  // namespace

double heightRounding(const HalfSpace& half_space, const BoxTree& surface, const EndPoses& poses) {
  const double size = (poses.X_AB_start * surface.origin()).norm() + (poses.X_AB_end * surface.origin()).norm() +
                      surface.origin().norm() + surface.ball().radius + std::abs(half_space.offset);
  return 32.0 * std::numeric_limits<double>::epsilon() * size;
}

LowestPoint lowestPoint(const HalfSpace& half_space, const BoxTree& surface, const Isometry3d& X_FP, double accuracy,
                        SeparationWitness& witness, SeparationMemory& memory) {
  const Upward up(half_space, X_FP);
  const LowestTriangle lowest = LowestSearch(surface, up, kNoTarget, accuracy, memory).run(witness.near_b);
  witness.near_b = lowest.triangle;
  return {lowest.height, lowest.at_least, pointOf(lowest, surface, up, half_space, X_FP)};
}

Separation planeSeparation(const HalfSpace& half_space, const BoxTree& surface, const TwoBodyMotion& motion,
                           const SeparationOptions& options, SeparationWitness& witness, SeparationMemory& memory) {
  return PlaneQuery(half_space, surface, motion, options, witness, memory).run();
}

}  // namespace sdf_ccd
