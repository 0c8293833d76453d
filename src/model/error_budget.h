#pragma once

namespace sdf_ccd {

/// How far the verdict about a pair may be off, shared out to its sources (design §3.11).
struct ErrorBudget {
  double field = 0.0;            ///< FieldOptions::max_error [m]
  double edge_gap = 0.0;         ///< ShellOptions::edge_gap [m]
  double chord_tolerance = 0.0;  ///< ChordOptions::tolerance, and MotionSampling's [m]
  double face_spacing = 0.0;     ///< ShellOptions::spacing [m]; no part of the bound where both bodies have shells

  /// What they add up to. Both bodies' motions between transforms and their chords each stray by the tolerance.
  double total() const { return field + edge_gap + kChords * chord_tolerance; }

  static constexpr double kChords = 3.0;
};

/// Shares `max_error` [m] out to field, edges and chords as 55 : 35 : 9. Their sum is 1 % short of it, for contact
/// times and rounding.
///
/// Why these: with both shares at 0.25, 0.5 or 1 mm, on nine links of Panda and UR5, a field's time goes as e^-1 to
/// e^-1.7 and a shell's as 1/e. At equal shares of 0.5 mm a link's field takes 0.07 to 0.4 s and its shell 0.03 to 1 s
/// where the mesh is sound, but 2 to 13 s and 0.3 to 1 s where it cuts itself; and 0.1 to 2.1 MB beside 0.1 to 3.2 MB.
/// So time asks for a larger share of the field and memory for one of the shell, and neither changes fast near equal
/// shares: at 55 to 35 a time of 8/e + 1/g is 7 % above its least, a memory of 1/e + 3/g 25 %.
/// @throws std::invalid_argument if max_error is not finite, or below a nanometre.
ErrorBudget shareOut(double max_error);

}  // namespace sdf_ccd
