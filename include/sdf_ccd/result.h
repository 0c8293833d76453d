#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/segments.h"
#include "sdf_ccd/trajectory.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// What a check says about a pair of bodies, or about several pairs. The numbers are those of the messages: a zeroed
/// message says NOT_CHECKED. They are in no order of severity, so verdicts are not compared by them.
enum class Verdict : std::uint8_t {
  kNotChecked = 0,  ///< could not be checked, and why
  kClear = 1,       ///< apart at all times, even if the errors reach their bounds
  kUncertain = 2,   ///< neither is proved, as the errors may be as large as their bounds
  kContact = 3,     ///< touching at some time, even if the errors reach their bounds
};

/// By severity: see isWorse().
///@{
bool operator<(Verdict, Verdict) = delete;
bool operator>(Verdict, Verdict) = delete;
bool operator<=(Verdict, Verdict) = delete;
bool operator>=(Verdict, Verdict) = delete;
///@}

/// Whether `a` is more severe than `b`: CLEAR, NOT_CHECKED, UNCERTAIN, CONTACT, the most severe last.
bool isWorse(Verdict a, Verdict b);

/// The more severe of two.
inline Verdict worseOf(Verdict a, Verdict b) {
  return isWorse(b, a) ? b : a;
}

/// Whether the bodies may touch, as far as the check tells: UNCERTAIN or CONTACT.
inline bool mayTouch(Verdict verdict) {
  return verdict == Verdict::kUncertain || verdict == Verdict::kContact;
}

/// "CLEAR", "NOT_CHECKED", "UNCERTAIN" or "CONTACT".
const char* toString(Verdict verdict);

/// Bounds of a verdict's errors, by source [m].
struct ErrorSources {
  double field = 0.0;  ///< sampling, interpolation, rounding of the field
  double chord = 0.0;  ///< arcs taken as chords, errors of poses, rounding of shell points
  double root = 0.0;   ///< tolerance of contact times, as a length
  double gap = 0.0;    ///< where surfaces touch: to the nearest shell point, or to the triangles that stand for a
                       ///< surface; where triangles leave a pair UNCERTAIN, plus the distance that they can resolve

  /// For "no contact": the surface between the points counts, too.
  double total() const { return field + chord + root + gap; }
  /// For "contact": whether a surface point of this depth is proof, whatever lies between the points. It must be deeper
  /// than what the motion adds (chord, root) plus the field's error: the bound for the band or, often much less, the
  /// error at the point's location. This holds in the band. Beyond it, the bound for the band only implies that the
  /// point is at least as deep as the band, which is proof as long as the motion adds less.
  /// @param depth_error  of the field at that location [m].
  bool provesContact(double depth, double depth_error) const {
    return depth > (depth_error < field ? depth_error : field) + chord + root;
  }
};

/// What stiffness and damping of a shell point are multiplied by.
enum class StiffnessPer {
  kArea,  ///< the area that the point represents: forces do not depend on the number of points
  kPoint  ///< nothing (the paper): forces grow with the number of points
};

/// The direction of a point's force.
enum class NormalSource {
  kField,  ///< the gradient of the field
  kShell   ///< the point's own normal, inward
};

/// How forces are integrated over the time of a contact.
enum class Quadrature {
  kExact,    ///< Gauss's rule between the faces of the field's cells
  kMidpoint  ///< the paper's rule, with ContactOptions::midpoint_intervals
};

/// The contact model (paper §4).
struct ContactOptions {
  StiffnessPer stiffness_per = StiffnessPer::kArea;
  double stiffness = 1e8;  ///< k: per area [N/m³] (elastic foundation) or per point [N/m] (the paper)
  double damping = 0.0;    ///< k_D: per area [N·s/m³] or per point [N·s/m]; 0 leaves the damping term out
  NormalSource normal = NormalSource::kField;
  Quadrature quadrature = Quadrature::kExact;
  int midpoint_intervals = 20;  ///< of the midpoint rule, per contact interval (paper §4: 20)
};

/// Throws std::invalid_argument, with the value, for a stiffness or damping that is negative or not finite, or a
/// count below 1.
void validate(const ContactOptions& options);

/// One contact of one shell point.
struct ContactPoint {
  double enter = 0.0;  ///< [s] from t₀
  double exit = 0.0;   ///< [s] from t₀
  double time = 0.0;   ///< when it is deepest [s] from t₀
  double depth = 0.0;  ///< [m]
  /// Of the depth [m], from the field at this point: mostly less than ErrorSources::field. Beyond the band the point
  /// may get deeper at another time by up to this. If the surfaces cross without any point inside, the depth is 0, and
  /// they are no deeper than this. In a body of several parts the depth is that in one of them; where parts meet, the
  /// body may be deeper by up to this, but is never less deep by more than the field's error.
  double depth_error = 0.0;
  Vector3d p_W = Vector3d::Zero();       ///< when deepest [m]
  Vector3d normal_W = Vector3d::Zero();  ///< unit, from body A to body B
};

/// What a cycle says about one pair.
struct PairResult {
  int body_a = -1;
  int body_b = -1;
  Verdict verdict = Verdict::kNotChecked;
  std::string reason;    ///< why it was not checked, is incomplete, or has no force (wrenches are NaN); else empty
  WaypointSpan span;     ///< the part of the motion that was checked; empty if the pair is delayed
  bool skipped = false;  ///< CLEAR without a test, by the clearance known from an earlier cycle
  /// UNCERTAIN because no time was left to test it: by what is known from earlier cycles, the bodies overlap by no more
  /// than the error.
  bool postponed = false;
  /// CONTACT, but no time was left to compute it: `reason` tells what is missing. If that is its times, depth and
  /// force, the only interval is the whole span, during which it touches at `deepest` at least; its depth is up to
  /// deepest.depth + depth_error, the greatest that the bodies allow; there are no points, and wrenches are NaN.
  bool incomplete = false;
  ErrorSources error;          ///< of the verdict
  ErrorSources contact_error;  ///< of what fields and shells tell: points and, unless measured, intervals and depths;
                               ///< zero if they tell nothing
  double clearance = 0.0;      ///< lower bound of the distance at the span's end, the motion's error taken off [m];
                               ///< negative if not known. See CycleRequest::skipped_pairs
  std::vector<Interval> intervals;  ///< of any contact, φ ≤ 0 [s] from t₀
  /// Valid if intervals is not empty; beyond the band, its error holds for all points. If measured, no point of either
  /// surface gets deeper than this depth by more than depth_error within the span.
  ContactPoint deepest;
  /// Whether intervals and depths were measured on the surfaces: those of bodies with certain solids. The others' come
  /// from fields and shells.
  bool measured = false;
  /// If measured, and the surfaces meet: the bodies are apart before `enter`, where the first interval begins, and
  /// certainly touch by `exit`, which is infinite if no certain crossing was found. Not set if one body may be inside
  /// the other at the start, unless that is a half-space.
  std::optional<Interval> first_touch;
  /// Likewise: they certainly touch at `enter`, which may be −∞, and are apart after `exit`, where the last interval
  /// ends.
  std::optional<Interval> last_touch;
  Wrench on_a_W;  ///< average over the span, world axes, about A's origin at its end
  Wrench on_b_W;  ///< the same on B, about B's origin
  std::vector<ContactPoint> points;
  /// Of each interval with shell points inside the deepest one, of others a crossing of the surfaces; in any order.
  std::vector<ContactPoint> peaks;
};

/// What a cycle says about all pairs.
struct CycleResult {
  std::vector<PairResult> pairs;           ///< in the order of Scene::pairs
  std::vector<int> not_clear;              ///< indices of those that are neither CLEAR nor delayed, increasing
  std::vector<int> failed;                 ///< not in not_clear: NOT_CHECKED in all cycles, as a body was not built
  Verdict verdict = Verdict::kNotChecked;  ///< worst of all pairs: CONTACT, UNCERTAIN, NOT_CHECKED, CLEAR;
                                           ///< NOT_CHECKED if there are none, or some are delayed and the others CLEAR
  double error_bound = 0.0;                ///< largest of the pairs checked [m]
  ErrorSources error;                      ///< of that pair, by source
  double contact_error = 0.0;              ///< largest PairResult::contact_error of all pairs [m]
  int checked = 0;
  int skipped = 0;
  int not_checked = 0;
  int delayed = 0;
  int postponed = 0;
  int incomplete = 0;     ///< of those checked
  double run_time = 0.0;  ///< [s]
};

}  // namespace sdf_ccd
