#pragma once

#include <vector>

#include "contact_search.h"

namespace sdf_ccd {

/// A shell point that was in contact during a step, in its state at the end of the step.
struct PointContact {
  double stiffness = 0.0;  ///< [N/m], with the role's weight
  double damping = 0.0;    ///< [N·s/m], with the role's weight and the share of the step spent in contact
  double depth = 0.0;      ///< min(φ, 0) [m]
  double gap = 0.0;        ///< [m], gives the force: the depth, or the distance behind the surface that it crossed
  Vector3d slope;          ///< derivative of the gap by the point's position, O's axes: out of the field's body
  Vector3d inward;         ///< minus the shell's normal, O's axes
  Vector3d r_P, r_F;       ///< from either body's origin to the point [m], O's axes
};

struct PairContacts {
  int shell_body;
  int field_body;
  Vector3d p_OP, p_OF;  ///< the bodies' origins at that time [m]
  std::vector<PointContact> points;
};

/// All contacts of a motion, at its end.
///
/// A point that has left the solid on the side where it entered is listed with no gap (but with its damping). A point
/// that passed through is held by the plane where it entered: its gap is negative whatever the field is at its end. It
/// has passed if it left by a face opposite to that plane, as those of a thin plate, or if it was deeper inside than
/// the error of its path and field, as in a corner; past an edge that it only grazed it goes on.
void endContacts(const RigidWorld& world, const StepMotion& motion, ContactSearch& search,
                 std::vector<PairContacts>& contacts);

/// The contacts of bodies at rest.
void contactsAtRest(const RigidWorld& world, const std::vector<BodyState>& states, ContactSearch& search,
                    std::vector<PairContacts>& contacts);

/// Σ ½ k φ² [J].
double elasticEnergy(const PairContacts& contacts);
double elasticEnergy(const std::vector<PairContacts>& contacts);

}  // namespace sdf_ccd
