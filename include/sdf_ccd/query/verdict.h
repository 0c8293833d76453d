#pragma once

namespace sdf_ccd {

enum class Verdict {
  kClear,       ///< nowhere nearer than the error bound
  kContact,     ///< somewhere deeper than the error bound
  kUncertain,   ///< within the error bound
  kNotChecked,  ///< could not be checked, and why
};

const char* toString(Verdict verdict);

/// What a verdict may be wrong by, by source [m].
struct ErrorBound {
  double field = 0.0;  ///< sampling, interpolation, rounding of the field
  double chord = 0.0;  ///< arcs taken as chords
  double root = 0.0;   ///< tolerance of contact times, as a length
  double gap = 0.0;    ///< largest gap between surface and nearest shell point

  /// For "no contact": the surface between the points counts.
  double total() const { return field + chord + root + gap; }
  /// For "contact": a point of the surface that is deeper than this is proof, whatever lies between the points.
  double point() const { return field + chord + root; }
};

}  // namespace sdf_ccd
