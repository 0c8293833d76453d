#include "surface_pair.h"

#include <algorithm>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "motion/time_at.h"
#include "pose_rounding.h"
#include "scene/pair_bound.h"
#include "surface/plane_separation.h"

namespace sdf_ccd {
namespace {

/// Whether the first of two bodies is body F.
bool isFirstF(const Body& a, const Body& b) {
  if (a.half_spaces.empty() && b.half_spaces.empty()) return a.ball.radius >= b.ball.radius;
  return !a.half_spaces.empty();
}

}  // namespace

SurfacePair::SurfacePair(const Body& a, const Body& b, double resolution)
    : f_is_a_(isFirstF(a, b)),
      field_(f_is_a_ ? &a : &b),
      shell_(f_is_a_ ? &b : &a),
      motion_(*field_, *shell_, f_is_a_),
      deviation_(deviationOf(a, b)),
      resolution_(resolution),
      planes_(field_->half_spaces) {
  double of_planes = 0.0;
  for (const BodyHalfSpace& plane : planes_) of_planes = std::max(of_planes, plane.deviation);
  deviation_ += of_planes;
}

void SurfacePair::setMotion(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds) {
  constexpr int kMostPoses = 200000;  // takes some tenths of a second
  motion_.set(pair, bounds);
  poses_left_ = kMostPoses;
}

double SurfacePair::ballClearance(const Isometry3d& X_FP) const {
  const Vector3d center_F = X_FP * shell_->ball.center;
  double to_f = kInfinity;
  for (const BodyHalfSpace& plane : planes_)
    to_f = std::min(to_f, plane.half_space.normal.dot(center_F) - plane.half_space.offset);
  if (field_->triangles) to_f = std::min(to_f, (center_F - field_->ball.center).norm() - field_->ball.radius);
  return to_f - shell_->ball.radius;
}

SurfacePair::Answer SurfacePair::decide(double motion_error, SeparationMemory& memory) {
  const double at_end = ballClearance(motion_.end());
  if (ballClearance(motion_.start()) - motion_.travel() > std::max(motion_error, size()))
    return {SeparationState::kApart, at_end, true, {}, kInfinity};
  Answer answer = decideNear(motion_error + deviation_, memory);
  answer.clearance = std::max(answer.clearance, at_end);
  return answer;
}

/// The same by the triangles. @param margin  the motion's error and the deviation of the triangles [m].
SurfacePair::Answer SurfacePair::decideNear(double margin, SeparationMemory& memory) {
  if (isWithHalfSpace()) {
    Answer answer = decideBy(false, margin, memory);
    if (answer.crossing && isBelowThroughout(margin, memory)) {
      answer.crossing->enter = motion_.motion(0).t_start;
      answer.crossing->exit = motion_.endTime();
    }
    return answer;
  }
  const bool has_caps = (field_->triangles && field_->triangles->closed) || shell_->triangles->closed;
  if (!has_caps) return decideBy(false, margin, memory);
  // Apart including the caps that close openings: nothing has entered through an opening.
  const Answer closed = decideBy(true, margin, memory);
  if (closed.state == SeparationState::kApart) return closed;
  Answer open = decideBy(false, margin, memory);
  if (open.state == SeparationState::kApart) open.state = SeparationState::kOpen;  // perhaps inside
  return open;
}

Separation SurfacePair::test(bool closed, const TwoBodyMotion& motion, const SeparationOptions& options,
                             SeparationMemory& memory) {
  checkCancelled();  // a short search does not check
  SeparationWitness& witness = closed ? closed_witness_ : witness_;
  const BodyTriangles& p = *shell_->triangles;
  std::optional<Separation> all;
  const auto add = [&](const Separation& found) {
    if (!all || found.state == SeparationState::kCrossing) {
      all = found;
      return;
    }
    all->distance = std::min(all->distance, found.distance);
    all->tests += found.tests;
    all->open_within = kInfinity;
    if (found.state == SeparationState::kOpen) all->state = SeparationState::kOpen;
  };
  found_plane_ = false;
  for (const BodyHalfSpace& plane : planes_) {
    SeparationOptions limited = options;
    limited.max_tests = poses_left_;
    add(planeSeparation(plane.half_space, p.tree, motion, limited, witness, memory));
    poses_left_ = std::max(0, poses_left_ - all->tests);
    found_plane_ = all->state == SeparationState::kCrossing;
    if (found_plane_) return *all;
  }
  if (!field_->triangles) return *all;
  const BodyTriangles& f = *field_->triangles;
  add(closed ? separation(f.closedTree(), p.closedTree(), motion, options, witness, memory)
             : separation(f.tree, p.tree, motion, options, witness, memory));
  return *all;
}

/// Looks closer at surfaces that graze each other within the resolution. Those are rare, so that a much finer one costs
/// nothing on average; what stays that near, as a part that slides on a table, takes a few tests more in each cycle.
Separation SurfacePair::testCloser(bool closed, const TwoBodyMotion& motion, SeparationOptions options,
                                   SeparationMemory& memory) {
  constexpr double kFiner = 0.02;
  constexpr int kMaxTests = 2000;
  Separation found = test(closed, motion, options, memory);
  if (isWithHalfSpace() || found.open_within == kInfinity || found.tests >= options.max_tests) return found;
  options.resolution *= kFiner;
  options.max_tests = std::min(kMaxTests, options.max_tests - found.tests);
  const Separation closer = test(closed, motion, options, memory);
  const int tests = found.tests + closer.tests;
  if (closer.state != SeparationState::kOpen) found = closer;
  found.tests = tests;
  return found;
}

SurfacePair::Answer SurfacePair::decideBy(bool closed, double margin, SeparationMemory& memory) {
  Answer answer;
  double distance = -kInfinity;
  bool apart = true;
  SeparationOptions options;
  options.margin = margin;
  options.resolution = resolution_;
  const CancelPoint cancel;
  for (std::size_t step = 0; step < motion_.steps(); ++step) {
    cancel.check();
    const double travel = motion_.bounds(step).travel;
    if (distance - travel > margin) {
      distance -= travel;
      continue;
    }
    const Separation found = testCloser(closed, motion_.motion(step), options, memory);
    if (found.state == SeparationState::kCrossing) {
      answer.state = found.state;
      answer.crossing = contactAt(found, step, found.s);
      return answer;
    }
    const bool now = found.state == SeparationState::kApart;
    distance = now ? found.distance : -kInfinity;
    if (now) continue;
    // What holds for a half-space must hold at all times, of others at any time.
    answer.open_within = apart               ? found.open_within
                         : isWithHalfSpace() ? std::max(answer.open_within, found.open_within)
                                             : std::min(answer.open_within, found.open_within);
    apart = false;
    // A motion of many undecided steps takes no longer than a single one.
    options.max_tests -= found.tests;
    if (!isWithHalfSpace() && options.max_tests <= 0) return answer;
  }
  if (!apart) return answer;
  answer.state = SeparationState::kApart;
  answer.clearance = distance - deviation_;
  return answer;
}

/// Whether a part of the body stays below the plane all the time.
bool SurfacePair::isBelowThroughout(double margin, SeparationMemory& memory) {
  const double rounding = kTimeRounding * motion_.reach();
  for (std::size_t step = 0; step < motion_.steps(); ++step)
    if (!isBelow(motion_.motion(step), 0.0, 1.0, margin + rounding, memory)) return false;
  return true;
}

/// The same for a part of a step: if what is lowest at its start does not stay below up to its end, its halves may
/// tell.
bool SurfacePair::isBelow(const TwoBodyMotion& motion, double start, double end, double margin,
                          SeparationMemory& memory) {
  checkCancelled();
  const HalfSpace& plane = planes_.front().half_space;
  const Isometry3d X_start = motion.X_FP(start);
  const LowestPoint lowest = lowestPoint(plane, shell_->triangles->tree, X_start, resolution_, witness_, memory);
  if (!(lowest.height < -margin) || --poses_left_ < 0) return false;
  const double length = end - start, bend = motion.acceleration * length * length / 8.0;
  const double at_end = plane.normal.dot(motion.X_FP(end) * (X_start.inverse() * lowest.p_F)) - plane.offset;
  if (std::max(lowest.height, at_end) + bend < -margin) return true;
  const double middle = 0.5 * (start + end);
  return bend > 0.02 * resolution_ && isBelow(motion, start, middle, margin, memory) &&
         isBelow(motion, middle, end, margin, memory);
}

/// @param share  of the step at which the crossing was found.
ContactPoint SurfacePair::contactAt(const Separation& found, std::size_t step, double share) const {
  const TwoBodyMotion motion = motion_.motion(step);
  const Isometry3d X_WF = motion.X_WF.pose(share), X_WP = motion.X_WP.pose(share);
  ContactPoint contact;
  contact.time = contact.enter = contact.exit = timeAt(motion, share);
  contact.p_W = X_WF * found.p_A;
  Vector3d normal = X_WF.linear() * found.normal_A;
  // A single triangle does not tell the side: take the one where the other ball's centre lies.
  const Vector3d to_p = X_WP * shell_->ball.center - contact.p_W;
  if (!found_plane_ && !(normal.dot(to_p) > 0.0)) normal = -normal;
  contact.normal_W = fromAToB(normal);
  return contact;
}

/// The separation during a part of a step, between two shares of it; at one time if they are equal.
Separation SurfacePair::during(std::size_t step, double start, double end, double motion_error,
                               SeparationMemory& memory) {
  SeparationOptions options;
  options.margin = motion_error + deviation_ + kTimeRounding * motion_.reach();
  options.resolution = resolution_;
  return withPart(motion_.motion(step), start, end,
                  [&](const TwoBodyMotion& part) { return test(false, part, options, memory); });
}

std::optional<ContactPoint> SurfacePair::crossingAt(double time, double motion_error, SeparationMemory& memory) {
  const auto [step, share] = motion_.stepAt(time);
  const Separation found = during(step, share, share, motion_error, memory);
  if (found.state != SeparationState::kCrossing) return std::nullopt;
  ContactPoint contact = contactAt(found, step, share);
  contact.time = contact.enter = contact.exit = time;  // without the rounding of its share
  return contact;
}

std::optional<ContactPoint> SurfacePair::findContact(double motion_error, SeparationMemory& memory) {
  const double start = motion_.startTime(), end = motion_.endTime();
  const auto at = [&](double share) { return crossingAt(start + share * (end - start), motion_error, memory); };
  if (auto crossing = crossingAt(end, motion_error, memory)) return crossing;
  if (motion_.travel() > resolution_)
    for (const double share : {0.0, 0.5, 0.25, 0.75})
      if (auto crossing = at(share)) return crossing;
  const double margin = motion_error + deviation_ + kTimeRounding * motion_.reach();
  const std::optional<InsidePoint> inside = deepPoint(*field_, *shell_, motion_.end(), margin, memory);
  return inside ? std::make_optional(contactAtEnd(*inside)) : std::nullopt;
}

std::optional<SurfacePair::Touch> SurfacePair::touch(double from, double to, double motion_error,
                                                     SeparationMemory& memory) {
  constexpr int kMaxHalvings = 60;
  const auto [first, first_share] = motion_.stepAt(from);
  const auto [last, last_share] = motion_.stepAt(to);
  const bool backward = to < from;
  std::optional<Touch> touch;
  for (std::size_t step = first;; backward ? --step : ++step) {
    const double begin = step == first ? first_share : backward ? 1.0 : 0.0;
    const double length = (step == last ? last_share : backward ? 0.0 : 1.0) - begin;
    const auto time = [&](double along) { return timeAt(motion_.motion(step), begin + along * length); };
    const auto over = [&](double start, double end) {
      return during(step, begin + start * length, begin + end * length, motion_error, memory);
    };
    // No part of a step is more than twice as fast as the whole (see relativeMotionBounds()).
    const double travel = motion_.bounds(step).travel * std::min(1.0, 2.0 * std::abs(length));
    const Separation found = over(0.0, 1.0);
    if (found.state != SeparationState::kApart) {
      double apart = 0.0, end = 1.0, crossing = kInfinity;  // apart until; not known apart at; crossing at
      if (found.state == SeparationState::kCrossing) end = crossing = found.s;
      for (int k = 0; !touch && k < kMaxHalvings && (end - apart) * travel > resolution_; ++k) {
        const double middle = 0.5 * (apart + end);
        const Separation part = over(apart, middle);
        if (part.state == SeparationState::kApart) {
          apart = middle;
        } else {
          const bool crosses = part.state == SeparationState::kCrossing;
          end = crosses ? apart + part.s * (middle - apart) : middle;
          if (crosses) crossing = end;
        }
      }
      if (!touch) touch = Touch{time(apart), std::nullopt};
      if (crossing < kInfinity) {
        touch->crossing = time(crossing);
        return touch;
      }
    }
    if (step == last) return touch;
  }
}

Containment SurfacePair::containment(const Isometry3d& X_FP, int attempt) const {
  if (!field_->triangles) return {true, std::nullopt};
  return containmentOf(*field_, *shell_, X_FP, attempt);
}

/// The contact at a point that is inside at the motion's end. Its normal is as the bodies' balls lie.
ContactPoint SurfacePair::contactAtEnd(const InsidePoint& inside) const {
  const TwoBodyMotion last = motion_.motion(motion_.steps() - 1);
  const Isometry3d X_WF = last.X_WF.pose(1.0), X_WP = last.X_WP.pose(1.0);
  const Vector3d displacement = X_WP * shell_->ball.center - X_WF * field_->ball.center;
  ContactPoint contact;
  contact.enter = contact.exit = contact.time = last.t_end;
  contact.p_W = (inside.is_of_p ? X_WP : X_WF) * inside.p;
  contact.normal_W =
      fromAToB(displacement.norm() > 0.0 ? Vector3d(displacement.normalized()) : Vector3d(Vector3d::UnitZ()));
  return contact;
}

ContactPoint SurfacePair::contactInside(const InsidePoint& inside) const {
  ContactPoint contact = contactAtEnd(inside);
  contact.enter = motion_.startTime();
  return contact;
}

}  // namespace sdf_ccd
