#pragma once

#include <vector>

#include "motion/chords.h"
#include "query/shell_query.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/result.h"
#include "shell/point_shell.h"

namespace sdf_ccd {

/// Another part of the body that carries the field. Where it is deeper, the contact belongs to it, so that a point
/// inside two overlapping parts counts once.
struct SiblingField {
  const DistanceField* field;
  Isometry3d X_GF;  ///< from this field's frame F to the sibling's G
  bool wins_tie;    ///< takes the contact if both are equally deep
};

/// One shell against one field, after shellIntervals().
struct ContactInput {
  const DistanceField& field;
  const PointShell& shell;
  const ChordPath& path;                ///< X_FP
  const std::vector<Isometry3d>& X_CF;  ///< F in an unaccelerated frame C: at the first chord's start and at
                                        ///< every chord's end, so one more than there are chords
  const std::vector<SiblingField>& siblings;
};

/// Deepest point of a hit.
struct HitDepth {
  bool siblings = false;  ///< the whole contact belongs to siblings: the other members are not set
  double depth = 0.0;     ///< [m], positive inside, at a sampled point of the path; the maximum: leastDistance()
  double error = 0.0;     ///< of the depth [m]: depthError(), larger beyond the band
  /// Of a point that gets as deep as the field's band: upper bound of its depth during the hit [m], as values beyond
  /// the band do not tell where it is deepest; otherwise 0.
  double reach = 0.0;
  double time = 0.0;                     ///< [s]
  Vector3d p_F = Vector3d::Zero();       ///< contact point [m], frame F
  Vector3d p_C = Vector3d::Zero();       ///< the same in frame C
  Vector3d normal_C = Vector3d::Zero();  ///< unit, out of the field's body
};

/// Outputs of integrateContact() other than depths.
struct ContactRequest {
  bool impulse = true;
  bool depth_errors = true;  ///< else `error`, which is depthError(), is not set
};

/// Impulses over all hits.
struct ContactImpulse {
  Wrench on_shell_body;          ///< I [N·s] and M about C's origin [N·m·s] on P; on F it is the opposite (Eq. 6, 7)
  std::vector<HitDepth> depths;  ///< one per hit
  std::vector<double> breaks;    ///< scratch memory, reused from hit to hit
};

/// Error of the depth found at a point of a path [m]: that of the field there, and what the field's value there differs
/// by. It does at the face between two cells of an adaptive field, where rounding decides which cell the point is in.
double depthError(const DistanceField& field, const Vector3d& p_F, double depth);

/// Integrates penalty force F = −k d N (N out of the field's body, d < 0 inside) and damping force −k_D v_rel over
/// the hits (paper Eq. 3–11; signs as in design §3.6). Divide by the cycle's length for the average (Eq. 8, 9).
/// The exact rule is three-point Gauss on each cell's piece (design §3.9): exact for an interpolated field, a constant
/// N and an F that does not rotate in C. A field's normal turns within a cell where its nearest face changes: the
/// error is then mostly below 1e-3 of the impulse, at worst about 1e-2. The midpoint rule is the paper's. Where the
/// field's gradient is unknown (far inside), the shell point's inward normal replaces it. Reuses the memory of
/// `result`.
/// @throws std::invalid_argument if X_CF has not one pose more than the path has chords.
void integrateContact(const ContactInput& input, const std::vector<ShellHit>& hits, const ContactOptions& options,
                      const ContactRequest& request, ContactImpulse& result);

}  // namespace sdf_ccd
