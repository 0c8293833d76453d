#pragma once

namespace sdf_ccd {

/// In increasing order of severity: of several pairs, the most severe verdict counts.
enum class Verdict {
  kClear,       ///< apart at all times, even if the errors reach their bounds
  kNotChecked,  ///< could not be checked, and why
  kUncertain,   ///< neither is proved, as the errors may be as large as their bounds
  kContact,     ///< touching at some time, even if the errors reach their bounds
};

/// "CLEAR", "NOT_CHECKED", "UNCERTAIN" or "CONTACT".
const char* toString(Verdict verdict);

/// Bounds of a verdict's errors, by source [m].
struct ErrorBound {
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
