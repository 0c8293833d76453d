#pragma once

namespace sdf_ccd {

/// The error bound of the verdict about a pair, divided among its sources (design §3.11).
struct ErrorBudget {
  double field = 0.0;            ///< FieldOptions::max_error [m]
  double edge_gap = 0.0;         ///< ShellOptions::edge_gap [m]
  double chord_tolerance = 0.0;  ///< ChordOptions::tolerance, and MotionSampling's [m]
  double face_spacing = 0.0;     ///< ShellOptions::spacing [m]; not part of the bound if both bodies have shells

  /// The sum. The motions of both bodies between transforms, and their chords, each deviate by the tolerance.
  double total() const { return field + edge_gap + kChords * chord_tolerance; }

  static constexpr double kChords = 3.0;
};

/// Divides `max_error` [m] among field, edges and chords as 55 : 35 : 9. Their sum leaves 1 % of it for contact times
/// and rounding.
///
/// Reason: with both shares at 0.25, 0.5 or 1 mm, on nine links of Panda and UR5, the build time of a field goes as
/// e^-1 to e^-1.7 and that of a shell as 1/e. At equal shares of 0.5 mm a link's field takes 0.07 to 0.4 s and its
/// shell 0.03 to 1 s if the mesh is sound, but 2 to 13 s and 0.3 to 1 s if it intersects itself; and 0.1 to 2.1 MB
/// and 0.1 to 3.2 MB. So time favours a larger share for the field and memory one for the shell, and neither
/// changes fast around equal shares: at 55 to 35 a time of 8/e + 1/g is 7 % above its minimum, a memory of 1/e +
/// 3/g 25 %.
ErrorBudget divideErrorBudget(double max_error);

/// The tolerance of each body's sampled motion [m] where triangles decide, which are exact: a fifth of `max_error` [m],
/// but at most the chords' tolerance [m].
double samplingTolerance(double max_error, double chord_tolerance);

}  // namespace sdf_ccd
