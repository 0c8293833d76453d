#pragma once

namespace sdf_ccd {

/// Worse ones are larger, and count for a number of pairs.
enum class Verdict {
  kClear,       ///< nowhere nearer than the error bound
  kNotChecked,  ///< could not be checked, and why
  kUncertain,   ///< neither is proved: apart by more than the error bound, or in contact
  kContact,     ///< somewhere deeper than the error bound
};

const char* toString(Verdict verdict);

/// Bounds of a verdict's errors, by source [m].
struct ErrorBound {
  double field = 0.0;  ///< sampling, interpolation, rounding of the field
  double chord = 0.0;  ///< arcs taken as chords
  double root = 0.0;   ///< tolerance of contact times, as a length
  double gap = 0.0;    ///< largest gap between surface and nearest shell point, or the triangles that stand for it; of
                       ///< what triangles left UNCERTAIN, how near they looked too

  /// For "no contact": the surface between the points counts.
  double total() const { return field + chord + root + gap; }
  /// For "contact": whether a surface point of this depth is proof, whatever lies between the points. It has to be
  /// deeper than the field's error, everywhere or, often much less, at its own location, and what the motion adds. In
  /// the band, that is: beyond it, the field's error everywhere says only that the point is as deep as the band, which
  /// is proof as long as the motion adds less.
  /// @param depth_error  of the field at that location [m].
  bool provesContact(double depth, double depth_error) const {
    return depth > (depth_error < field ? depth_error : field) + chord + root;
  }
};

}  // namespace sdf_ccd
