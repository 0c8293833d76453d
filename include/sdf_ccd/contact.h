#pragma once

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Force [N] and torque [N·m] about a reference point, or impulse [N·s] and angular impulse [N·m·s], in the axes of
/// one frame. Which point and which frame is said where it is used.
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d torque = Vector3d::Zero();

  /// Adds a wrench about the same point, in the same axes.
  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    torque += other.torque;
    return *this;
  }
};

/// Scales force and torque.
inline Wrench operator*(double factor, const Wrench& w) {
  return {factor * w.force, factor * w.torque};
}

/// The wrench `w_C`, about C's origin in C's axes, about B's origin in B's axes.
inline Wrench expressedIn(const Isometry3d& X_CB, const Wrench& w_C) {
  const Matrix3d R_BC = X_CB.linear().transpose();
  return {R_BC * w_C.force, R_BC * (w_C.torque - X_CB.translation().cross(w_C.force))};
}

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

}  // namespace sdf_ccd
