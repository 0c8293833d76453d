#pragma once

#include <cstdint>
#include <optional>

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

/// The most severe of several verdicts.
class WorstVerdict {
 public:
  /// Adds one of them.
  void add(Verdict verdict) { worst_ = worst_ ? worseOf(*worst_, verdict) : verdict; }

  /// NOT_CHECKED if there are none.
  Verdict value() const { return worst_.value_or(Verdict::kNotChecked); }

 private:
  std::optional<Verdict> worst_;
};

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

}  // namespace sdf_ccd
