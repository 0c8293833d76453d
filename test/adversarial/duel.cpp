#include "adversarial/duel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "oracle/shapes.h"

namespace sdf_ccd::test {
namespace {

constexpr Real kUnseen = 1e-9L;       ///< resolution of the oracle [sizes of the bodies]
constexpr int kSharp = 200;           ///< number of failures whose depth is computed to a thousandth of the bound
constexpr double kComparable = 10.0;  ///< only clearances below so many error bounds are compared

BodyDescription described(const std::string& name, const Actor& actor) {
  BodyDescription body;
  body.name = body.frame = name;
  body.geometry = actor.geometry;
  return body;
}

std::string text(const char* format, double x, double y) {
  char line[160];
  std::snprintf(line, sizeof(line), format, x, y);
  return line;
}

void addRatio(double bound, Real error, Tally& tally) {
  if (bound > 0.0) tally.bound_over_error.push_back(float(bound / double(std::max(error, Real(1e-6 * bound)))));
}

}  // namespace

double Actor::radius() const {
  Real radius = 0;
  for (const Convex& piece : outer())
    for (const Vector3l& p : piece.corners) radius = std::max(radius, p.norm());
  return double(radius);
}

Actor convexActor(const std::string& kind, const TriangleMesh& mesh, const Vector3d& offset) {
  const TriangleMesh moved = translated(mesh, offset);
  return {
      kind, {{std::make_shared<const TriangleMesh>(moved), Isometry3d::Identity(), kind}}, {convexOf(moved)}, {}, true};
}

Actor boxActor(const Vector3d& half_size, const Vector3d& offset) {
  Isometry3d X_BG = Isometry3d::Identity();
  X_BG.translation() = offset;
  return {"box",
          {{Primitive(Box::fromSize(2.0 * half_size)), X_BG, "box"}},
          {convexOf(translated(boxMesh(half_size), offset))},
          {},
          true};
}

Actor ballActor(double radius) {
  return {"ball", {{Primitive(Sphere{radius}), Isometry3d::Identity(), "ball"}}, {ball(radius)}, {}, true};
}

Duel::Duel(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor)
    : Duel(std::move(a), std::move(b), scene, monitor, false) {}

Duel Duel::inCompany(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor) {
  return Duel(std::move(a), std::move(b), scene, monitor, true);
}

Duel::Duel(Actor a, Actor b, const BodyOptions& scene, const MonitorOptions& monitor, bool in_company)
    : a_(std::move(a)), b_(std::move(b)), in_company_(in_company) {
  SceneDescription description{{described("a", a_), described("b", b_)}, {}};
  if (in_company_) {
    const Actor box = boxActor({0.1, 0.1, 0.1});
    // In front, as of equally urgent pairs the first is tested first.
    description.bodies.insert(description.bodies.begin(), {described("c", box), described("d", box)});
    for (const char* other : {"c", "d"})
      for (const char* own : {"a", "b"}) description.allowed.push_back({own, other, "far away"});
  }
  auto built =
      std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(scene)), scene));
  if (built->pairs.empty()) throw std::logic_error(name() + ": " + built->left_out.at(0).text);
  bound_ = built->contact_bound.total();
  size_ = a_.radius() + b_.radius();
  monitor_ = std::make_unique<Monitor>(std::move(built), monitor);
}

const PairResult& Duel::play(const CycleMotion& motion, Tally& tally) {
  monitor_->reset();
  const PairResult& result = monitor_->run(motion, {false, 0}).pairs.at(0);
  judge(motion, result, name(), tally);
  return result;
}

const PairResult& Duel::follow(const CycleMotion& motion, bool has_time) {
  CycleRequest request{false, 0};
  if (!in_company_) return monitor_->run(motion, request).pairs.at(0);
  if (!has_time) request.max_time = 1e-12;
  CycleMotion all = motion;
  const std::size_t times = motion.times.size();
  for (int k = 0; k < 2; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.translation() = Vector3d(50.0, k, cycles_ % 2);
    all.X_WB.insert(all.X_WB.begin(), std::vector<Isometry3d>(times, X));
    if (!all.motion_error.empty()) all.motion_error.insert(all.motion_error.begin(), 0.0);
  }
  if (!all.spans.empty()) all.spans.insert(all.spans.begin(), {0, times - 1});
  ++cycles_;
  return monitor_->run(all, request).pairs.at(1);
}

PairMotion Duel::motionOf(const CycleMotion& motion, const WaypointSpan& span, bool outer) const {
  const auto part = [&](const auto& all) { return std::vector(all.begin() + span.first, all.begin() + span.last + 1); };
  return {outer ? a_.outer() : a_.solid, outer ? b_.outer() : b_.solid, part(motion.times), part(motion.X_WB[0]),
          part(motion.X_WB[1])};
}

void Duel::judge(const CycleMotion& motion, const PairResult& result, const std::string& what, Tally& tally) const {
  const Real off = std::accumulate(motion.motion_error.begin(), motion.motion_error.end(), Real(0));
  judge(motionOf(motion, result.span, false), motionOf(motion, result.span, true), result, what, tally, off);
}

void Duel::judge(const PairMotion& solid, const PairMotion& outer, const PairResult& result, const std::string& what,
                 Tally& tally, Real off) const {
  ++tally.cases;
  switch (result.verdict) {
    case Verdict::kClear:
      ++tally.clear;
      return judgeClear(solid, result, what, tally);
    case Verdict::kContact:
      ++tally.contact;
      judgeContact(outer, result, what, tally);
      return judgeDepth(solid, result, what, tally);
    case Verdict::kUncertain:
      ++tally.uncertain;
      if (result.postponed) return judgePostponed(solid, result, what, tally);
      judgeNear(outer, result, off, what, tally);
      return judgeDepth(solid, result, what, tally);
    case Verdict::kNotChecked:
      ++tally.not_checked;
  }
}

/// Error of the oracle: of long doubles, and of rotations given as doubles [m].
Real Duel::rounding(const PairMotion& motion) const {
  return kUnseen * size_ + 1e-17L * motion.poseA(0).p.norm();
}

void Duel::judgeClear(const PairMotion& solid, const PairResult& result, const std::string& what, Tally& tally) const {
  const Real unseen = rounding(solid);
  LeastValue least = solid.least({0, 0, -unseen});
  if (least.high < -unseen) {
    if (++tally.false_clear <= kSharp) least = solid.least({1e-3L * bound_});
    tally.deepest = std::max(tally.deepest, double(-least.high));
    tally.fail(what + ": CLEAR", text("%.3g m deep at %.17g s", double(-least.high), double(least.at)));
    return;
  }
  if (result.clearance < 0.0) return;
  const Real end = solid.end();
  if (solid.at(end).value <= 0) return;
  const Real truth = solid.distanceAt(end);
  if (result.clearance > truth + unseen) {
    ++tally.false_bound;
    tally.fail(what + ": clearance", text("%.17g m, true %.17g m", result.clearance, double(truth)));
  }
  if (truth < kComparable * bound_ && !result.skipped)
    addRatio(result.error.total(), std::abs(truth - result.clearance), tally);
}

/// For a pair that was not tested, the reported error must be an upper bound of the overlap.
void Duel::judgePostponed(const PairMotion& solid, const PairResult& result, const std::string& what,
                          Tally& tally) const {
  const Real deep = result.error.total() + rounding(solid);
  const LeastValue least = solid.least({0, -deep, -deep});
  if (least.high >= -deep) return;
  ++tally.false_bound;
  tally.fail(what + ": postponed", text("%.3g m deep, reported %.3g m", double(-least.high), result.error.total()));
}

/// If the triangles leave a pair UNCERTAIN, the surfaces must come within the reported error of each other, at the
/// poses given to the monitor.
void Duel::judgeNear(const PairMotion& outer, const PairResult& result, Real off, const std::string& what,
                     Tally& tally) const {
  const bool by_triangles = result.error.total() < 1.1 * MonitorOptions().max_error + result.error.chord;
  if (!by_triangles) return;
  const Real near = result.error.total() + off + rounding(outer);
  const LeastValue least = outer.least({0, near, 0});
  if (least.low <= near) return;
  ++tally.false_bound;
  tally.fail(what + ": UNCERTAIN", text("%.3g m apart, reported %.3g m", double(least.low), result.error.total()));
}

void Duel::judgeContact(const PairMotion& outer, const PairResult& result, const std::string& what,
                        Tally& tally) const {
  if (outer.at(result.deepest.time).value <= 0) return;
  const Real unseen = rounding(outer);
  const LeastValue least = outer.least({0, unseen, 0});
  if (least.low <= unseen) return;
  ++tally.false_contact;
  tally.fail(what + ": CONTACT", text("%.3g m deep, but %.3g m apart", result.deepest.depth, double(least.high)));
}

/// The deepest point must lie on one surface and `depth` deep inside the other. If surfaces intersect but no point has
/// a depth, it must lie in both bodies.
void Duel::judgeDepth(const PairMotion& solid, const PairResult& result, const std::string& what, Tally& tally) const {
  if (result.intervals.empty() || !a_.is_convex || !b_.is_convex) return;
  const ContactPoint& deepest = result.deepest;
  const bool by_fields = result.contact_error.total() > 0.0;  // else the location comes from triangles
  const ErrorSources& told = by_fields ? result.contact_error : result.error;
  const Real time = deepest.time;
  const auto in = [&](const Convex& piece, const LongPose& X) {
    return signedDistance(piece, X.R.transpose() * (deepest.p_W.cast<Real>() - X.p));
  };
  const Real in_a = in(a_.solid[0], solid.poseA(time)), in_b = in(b_.solid[0], solid.poseB(time));
  if (!(deepest.depth > 0.0)) {
    const Real outside = std::max(in_a, in_b);
    if (outside <= told.total() + rounding(solid)) return;
    ++tally.false_bound;
    tally.fail(what + ": place", text("%.3g m outside of a body, reported %.3g m", double(outside), told.total()));
    return;
  }
  const Real depth = deepest.depth;
  const Real error =
      std::min(std::max(std::abs(in_a + depth), std::abs(in_b)), std::max(std::abs(in_b + depth), std::abs(in_a)));
  // The chord error displaces the point too.
  const Real bound = deepest.depth_error + told.root + 2.0 * told.chord;
  addRatio(double(bound), error, tally);
  if (error <= bound + rounding(solid)) return;
  ++tally.false_bound;
  tally.fail(what + ": depth", text("off by %.3g m, reported %.3g m", double(error), double(bound)));
}

LeastValue Duel::least(const CycleMotion& motion, const WaypointSpan& span, const LeastOptions& options) const {
  return motionOf(motion, span, false).least(options);
}

Vector3d Duel::aim(double wanted, CycleMotion& motion) const {
  const WaypointSpan span{0, motion.times.size() - 1};
  return aim(
      wanted, [&] { return motionOf(motion, span, false); }, [&](const Vector3d& by) { shiftB(by, motion); });
}

Vector3d Duel::aim(double wanted, const std::function<PairMotion()>& motion,
                   const std::function<void(const Vector3d&)>& shift) const {
  LeastOptions options;
  options.max_samples = 400;
  Vector3d axis = Vector3d::UnitX();
  for (int i = 0; i < 4; ++i) {
    const PairMotion pair = motion();
    options.tolerance = i < 2 ? 0.02L * size_ : Real(0.1 * bound_);
    const LeastValue least = pair.least(options);
    axis = pair.at(least.at).axis_W.cast<double>();
    const double missed = wanted - double(least.high);
    if (i >= 2 && std::abs(missed) < 0.2 * bound_) break;
    shift(missed * axis);
  }
  return axis;
}

CycleMotion pairCycle(std::vector<Isometry3d> X_WA, std::vector<Isometry3d> X_WB) {
  CycleMotion motion;
  for (std::size_t k = 0; k < X_WA.size(); ++k) motion.times.push_back(double(k) / double(X_WA.size() - 1));
  motion.X_WB = {std::move(X_WA), std::move(X_WB)};
  return motion;
}

void shiftB(const Vector3d& by, CycleMotion& motion) {
  for (Isometry3d& X : motion.X_WB[1]) X.translation() += by;
}

Isometry3d screwed(const Isometry3d& X, const Vector3d& point, const Vector3d& rotation_vector, const Vector3d& shift) {
  Isometry3d S = Isometry3d::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0.0) S.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  S.translation() = point - S.linear() * point + shift;
  Isometry3d result = S * X;
  result.linear() = Quaterniond(result.linear()).normalized().toRotationMatrix();
  return result;
}

double logUniform(Random& random, double low, double high) {
  return low * std::exp(uniform(random, 0.0, std::log(high / low)));
}

}  // namespace sdf_ccd::test
