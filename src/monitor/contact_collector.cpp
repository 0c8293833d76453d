#include "contact_collector.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "common/cancel_point.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "motion/time_at.h"
#include "query/smooth_pieces.h"
#include "scene/union_depth.h"

namespace sdf_ccd {
namespace {

constexpr double kJoin = 1e-9;  // relative to the span: times closer than this differ by rounding

// Limits of what is held at a time: some megabytes. Larger blocks cost as much per hit.
constexpr std::size_t kBlockHits = 1 << 17;  // per block of chords, unless a single chord has more
constexpr std::size_t kSomeHits = 1 << 14;   // integrated together
constexpr std::size_t kManyFound = 1 << 15;  // added to twice the number left after joining

}  // namespace

void ContactCollector::begin(const CycleMotion& motion, const PairResult& pair, bool crosses) {
  crosses_ = crosses;
  path_error_ = pair.contact_error.chord + pair.contact_error.root;
  deepest_ = group_reach_ = 0.0;
  position_error_ = 0.0;
  motion_ = &motion;
  span_ = pair.span;
  body_a_ = pair.body_a;
  body_b_ = pair.body_b;
  p_WC_ = motion.pose(body_a_, span_.last).translation();
  impulse_on_a_C_ = {};
  intervals_.clear();
  found_.clear();
  is_divided_ = false;
  most_found_ = most_intervals_ = kManyFound;
}

void ContactCollector::setFieldPoses(const PairRole& role) {
  const auto X_CF = [&](std::size_t waypoint) {
    Isometry3d X = motion_->pose(role.shellIsA() ? body_b_ : body_a_, waypoint);
    X.translation() -= p_WC_;
    return X;
  };
  X_CF_.assign(1, X_CF(span_.first));
  const std::vector<Chord>& chords = role.path().chords;
  CancelTicks<> cancel;
  for (std::size_t c = 0; c < chords.size();) {
    const int interval = chords[c].interval;
    const std::size_t waypoint = span_.first + interval;
    const double t0 = motion_->times[waypoint], t1 = motion_->times[waypoint + 1];
    const ScrewMotion screw(X_CF(waypoint), X_CF(waypoint + 1));
    for (; c < chords.size() && chords[c].interval == interval; ++c) {
      cancel.check();
      X_CF_.push_back(screw.pose(chords[c].t_end == t1 ? 1.0 : (chords[c].t_end - t0) / (t1 - t0)));
    }
  }
}

void ContactCollector::add(PairRole& role, double weight, const ContactOptions& options, bool with_impulse) {
  const bool shell_is_a = role.shellIsA();
  bool have_poses = false;
  CancelTicks<> cancel;
  solids_[shell_is_a ? 0 : 1] = &role.field();
  position_error_ = std::max(position_error_, role.shell().position_error);
  const std::size_t size = std::max<std::size_t>(1, kBlockHits / role.shell().size());
  const GroupedShell shell = role.groupedShell();
  const bool groups_points =
      !shell.sums.empty() && options.stiffness_per == StiffnessPer::kArea && options.normal == NormalSource::kField;
  for (std::size_t p = 0; p < role.field().parts.size(); ++p) {
    const BodyPart& part = role.field().parts[p];
    const ChordPath& path = role.partPath(part);
    const std::size_t chords = path.chords.size();
    if (chords > 1 || p > 0) is_divided_ = true;
    for (std::size_t first = 0; first < chords; first += size) {
      const ChordPath& block = blockOf(path, first, size);
      shellIntervals(part.field, role.shell(), shell.tree, block, query_);
      if (!query_.touches()) continue;
      if (!have_poses) setFieldPoses(role);
      have_poses = true;
      X_CG_.clear();
      for (std::size_t i = 0; i <= block.chords.size(); ++i) {
        cancel.check();
        X_CG_.push_back(X_CF_[first + i] * part.X_BG);
      }
      const ContactInput input{part.field, role.shell(), block, X_CG_, role.siblings(p)};
      const bool in_groups = groups_points && !part.field.hasOpenings();
      if (in_groups) {
        groups_.divide(part.field, shell, block, query_, listed_);
      } else {
        listHits(query_, listed_);
      }
      for (std::size_t done = 0; done < listed_.size(); done += kSomeHits) {
        hits_.assign(listed_.begin() + done, listed_.begin() + std::min(done + kSomeHits, listed_.size()));
        integrate(input, options, with_impulse);
        impulse_on_a_C_ += (shell_is_a ? weight : -weight) * impulse_.on_shell_body;  // Eq. 6, 7; action = reaction
        addHits(input, p, shell_is_a);
      }
      if (in_groups && !groups_.groups().empty()) {
        addGroups(input, p, shell, shell_is_a, weight, options, with_impulse);
      }
    }
  }
}

/// Adds the points that are deep together: their impulse, and those that show where and how deep they are.
void ContactCollector::addGroups(const ContactInput& input, std::size_t part, const GroupedShell& shell,
                                 bool shell_is_a, double weight, const ContactOptions& options, bool with_impulse) {
  if (with_impulse) {
    const ContactInput centroids{input.field, groups_.shell(), input.path, input.X_CF, input.siblings};
    integrateContact(centroids, groups_.hits(), options, {true, false}, impulse_);
    impulse_on_a_C_ += (shell_is_a ? weight : -weight) * impulse_.on_shell_body;
  }
  groups_.findDeep(input.field, shell, input.path, deepest_, hits_);
  integrateContact(input, hits_, options, {false, input.field.hasOpenings()}, impulse_);
  const std::vector<PointGroups::Group>& groups = groups_.groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    impulse_.depths[g].reach = groups[g].reach;
    group_reach_ = std::max(group_reach_, groups[g].reach);
  }
  addHits(input, part, shell_is_a);
}

/// Chords [first, first + size) of a path.
const ChordPath& ContactCollector::blockOf(const ChordPath& path, std::size_t first, std::size_t size) {
  if (size >= path.chords.size()) return path;
  const auto begin = path.chords.begin() + first;
  block_.chords.assign(begin, begin + std::min(size, path.chords.size() - first));
  block_.error = path.error;
  return block_;
}

/// Adds the hits that integrate() has processed.
void ContactCollector::addHits(const ContactInput& input, std::size_t part, bool shell_is_a) {
  CancelTicks<1024> cancel;
  for (std::size_t h = 0; h < hits_.size(); ++h) {
    cancel.check();
    const ShellHit& hit = hits_[h];
    const HitDepth& depth = impulse_.depths[h];
    const Chord& chord = input.path.chords[hit.chord];
    const Interval times{timeAt(chord, hit.interval.enter), timeAt(chord, hit.interval.exit)};
    // Most points are in contact all the time.
    if (intervals_.empty() || times.enter < intervals_.back().enter || times.exit > intervals_.back().exit)
      intervals_.push_back(times);
    if (depth.siblings) continue;
    Found found{shell_is_a ? 0 : 1,
                hit.point,
                {times.enter, times.exit, depth.time, depth.depth, depth.error, {}, {}},
                part,
                FieldAccess::openings(input.field) ? nullptr : &input.field,
                depth.p_F,
                depth.reach};
    found.contact.p_W = depth.p_C + p_WC_;
    deepest_ = std::max(deepest_, depth.depth);
    // Outward from the field's body, which is B if the shell is A's.
    found.contact.normal_W = shell_is_a ? Vector3d(-depth.normal_C) : depth.normal_C;
    found_.push_back(found);
  }
  joinWhereMany();
}

/// integrateContact() over all hits; in a field with openings only over those that may bear force.
void ContactCollector::integrate(const ContactInput& input, const ContactOptions& options, bool with_impulse) {
  const bool open = input.field.hasOpenings();
  integrateContact(input, hits_, options, {with_impulse && !open, open}, impulse_);
  if (!open) return;
  bearing_hits_.clear();
  for (std::size_t h = 0; h < hits_.size(); ++h) {
    const bool bears = bearsForce(input, h);
    if (bears) bearing_hits_.push_back(hits_[h]);
    // A depth to a cap, or of a point that may have entered through an opening, may be none at all.
    if (!bears) impulse_.depths[h].error = std::max(impulse_.depths[h].error, impulse_.depths[h].depth);
  }
  if (!with_impulse) return;
  integrateContact(input, bearing_hits_, options, {true, false}, bearing_impulse_);
  impulse_.on_shell_body = bearing_impulse_.on_shell_body;
}

/// Whether the depth is certainly to the mesh and of a contact: the surfaces cross, or the point may just touch.
bool ContactCollector::bearsForce(const ContactInput& input, std::size_t hit) const {
  const HitDepth& depth = impulse_.depths[hit];
  if (depth.siblings) return false;
  if (!crosses_ && depth.depth > depth.error + path_error_) return false;
  return !FieldAccess::openings(input.field)->isWithin(depth.p_F, depth.depth + depth.error);
}

/// Times that differ by less count as the same [s].
double ContactCollector::tolerance() const {
  return kJoin * duration();
}

/// Joins as finish() does, but before there is too much. Consecutive chords of a point join, so few remain.
void ContactCollector::joinWhereMany() {
  if (found_.size() > most_found_) {
    join();
    most_found_ = 2 * found_.size() + kManyFound;
  }
  if (intervals_.size() > most_intervals_) {
    mergeIntervals(intervals_, tolerance());
    most_intervals_ = 2 * intervals_.size() + kManyFound;
  }
}

/// Whether a point has several hits. Most have one, and then the large records need not be sorted.
bool ContactCollector::haveSharedPoint() {
  points_.clear();
  const double start = motion_->times[span_.first], end = motion_->times[span_.last];
  for (const Found& found : found_) {
    const bool is_only = !is_divided_ && found.contact.enter == start && found.contact.exit == end;
    if (!is_only) points_.push_back((std::uint32_t(found.role) << 31) | std::uint32_t(found.point));
  }
  CancelTicks<1024> cancel;
  std::sort(points_.begin(), points_.end(), [&](std::uint32_t a, std::uint32_t b) {
    cancel.check();
    return a < b;
  });
  return std::adjacent_find(points_.begin(), points_.end()) != points_.end();
}

/// Joins the hits of one point that meet, over chords and parts, to one contact.
void ContactCollector::join() {
  if (!haveSharedPoint()) return;
  CancelTicks<1024> cancel;
  std::sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) {
    cancel.check();
    return std::tie(a.role, a.point, a.contact.enter, a.contact.exit, a.contact.depth) <
           std::tie(b.role, b.point, b.contact.enter, b.contact.exit, b.contact.depth);
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < found_.size(); ++i) {
    Found& kept = found_[last];
    const Found& next = found_[i];
    const bool same =
        next.role == kept.role && next.point == kept.point && next.contact.enter <= kept.contact.exit + tolerance();
    if (!same) {
      found_[++last] = next;
      continue;
    }
    const double enter = kept.contact.enter, exit = std::max(kept.contact.exit, next.contact.exit);
    const double reach = std::max(kept.reach, next.reach);
    if (next.contact.depth > kept.contact.depth) kept = next;
    kept.reach = reach;
    kept.contact.enter = enter;
    kept.contact.exit = exit;
  }
  found_.resize(last + 1);
}

/// A total order, so that it does not matter in which one hits are found.
bool ContactCollector::isDeeper(const Found& a, const Found& b) {
  return std::tie(b.contact.depth, a.role, a.point, a.contact.enter) <
         std::tie(a.contact.depth, b.role, b.point, b.contact.enter);
}

/// Sets the first elements of by_depth_, up to `count`, to the deepest hits, in order.
void ContactCollector::sortDeepest(std::size_t count) {
  by_depth_.resize(found_.size());
  std::iota(by_depth_.begin(), by_depth_.end(), 0U);
  CancelTicks<1024> cancel;
  std::partial_sort(by_depth_.begin(), by_depth_.begin() + std::min(count, by_depth_.size()), by_depth_.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      cancel.check();
                      return isDeeper(found_[a], found_[b]);
                    });
}

/// Sets the error of a point's depth. @param reach  upper bound of the depth that it stands for [m].
void ContactCollector::setError(const Found& found, double reach, ContactPoint& point) const {
  if (found.field) point.depth_error = depthError(*found.field, found.p_F, point.depth);
  point.depth_error = std::max(point.depth_error, reach - point.depth) + position_error_;
}

/// Where parts of a body meet, a point may be deeper in it than in any of them.
void ContactCollector::allowForUnions() {
  CancelTicks<> cancel;
  for (Found& found : found_) {
    const Body& solid = *solids_[found.role];
    if (solid.parts.size() < 2) continue;
    cancel.check();
    const BodyPart& part = solid.parts[found.part];
    const double in_part = found.contact.depth + std::max(part.field.errorBound(), found.contact.depth_error);
    found.reach = std::max(found.reach, boundOfUnionDepth(solid, part.X_BG * found.p_F, in_part));
  }
}

/// Adds the deepest point of each interval.
void ContactCollector::addPeaks(PairResult& result) {
  if (found_.empty()) return;
  if (result.intervals.size() == 1) return result.peaks.push_back(result.deepest);
  peaks_.assign(result.intervals.size(), {});
  CancelTicks<1024> cancel;
  for (const Found& found : found_) {
    cancel.check();
    const auto after = std::upper_bound(result.intervals.begin(), result.intervals.end(), found.contact.time,
                                        [](double time, const Interval& interval) { return time < interval.enter; });
    if (after == result.intervals.begin()) continue;
    Peak& peak = peaks_[static_cast<std::size_t>(after - result.intervals.begin()) - 1];
    peak.reach = std::max(peak.reach, found.reach);
    if (!peak.deepest || isDeeper(found, *peak.deepest)) peak.deepest = &found;
  }
  for (const Peak& peak : peaks_) {
    if (!peak.deepest) continue;
    result.peaks.push_back(peak.deepest->contact);
    setError(*peak.deepest, peak.reach, result.peaks.back());
  }
}

void ContactCollector::finish(const CycleRequest& request, PairResult& result) {
  mergeIntervals(intervals_, tolerance());
  result.intervals = intervals_;
  join();
  allowForUnions();
  const std::size_t listed = std::min(found_.size(), static_cast<std::size_t>(std::max(request.max_points, 0)));
  sortDeepest(std::max<std::size_t>(listed, 1));
  for (std::size_t i = 0; i < listed; ++i) {
    const Found& found = found_[by_depth_[i]];
    result.points.push_back(found.contact);
    setError(found, found.reach, result.points.back());
  }
  if (!found_.empty()) {
    double reach = group_reach_;
    for (const Found& found : found_) reach = std::max(reach, found.reach);
    const Found& deepest = found_[by_depth_.front()];
    result.deepest = deepest.contact;
    setError(deepest, reach, result.deepest);
  }
  addPeaks(result);

  if (!request.wrenches) return;
  result.on_a_W = (1.0 / duration()) * impulse_on_a_C_;  // Eq. 8, 9; C's origin is A's at the end
  const Vector3d p_AB = motion_->pose(body_b_, span_.last).translation() - p_WC_;
  const Vector3d& force_on_a = result.on_a_W.force;
  result.on_b_W = {-force_on_a, p_AB.cross(force_on_a) - result.on_a_W.torque};
}

}  // namespace sdf_ccd
