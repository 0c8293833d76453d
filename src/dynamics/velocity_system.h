#pragma once

#include <vector>

#include <Eigen/Core>

#include "body_groups.h"
#include "dynamics/integrator.h"

namespace sdf_ccd {

/// The velocities of all bodies that move, as unknowns of one step: 6 each, v [m/s] and ω [rad/s] in O's axes.
///
/// Backward Euler is the minimum over V of Φ(V) = ½ (V−V₀)ᵀ M (V−V₀) + Σ ½ k gap(V)² + ½ Δt Vᵀ D V, V₀ the velocities
/// without contact. Its slope is a momentum balance; its second derivative, without the terms of the gap's curvature,
/// is M + Δt² Σ k jᵀj + Δt D: symmetric and positive definite whatever the stiffness.
class VelocitySystem {
 public:
  using Vector = Eigen::VectorXd;

  /// @param states  at the step's start: the inertias' axes.
  VelocitySystem(const RigidWorld& world, const std::vector<BodyState>& states, double duration);

  Vector velocitiesOf(const std::vector<BodyState>& states) const;
  void setVelocities(const Vector& V, std::vector<BodyState>& states) const;

  /// V₀: gravity and applied forces added.
  Vector withoutContact(const std::vector<BodyState>& states) const;

  /// Φ(V), as its sum; `damped` holds the points that damp, which do not change during the step.
  PerBody merit(const Vector& V, const Vector& V0, const std::vector<PairContacts>& contacts,
                const std::vector<PairContacts>& damped) const;

  struct Solution {
    Vector change;      ///< Newton's step from V
    PerBody decrease;   ///< expected decrease of Φ, times two [J]; a group's is the sum of its bodies'
    Reaction reaction;  ///< of contact at V + change
  };

  /// One Newton step from V, where the contacts are `contacts`.
  Solution solve(const Vector& V, const Vector& V0, const std::vector<PairContacts>& contacts,
                 const std::vector<PairContacts>& damped) const;

  /// Changes the depths of points that are inside as their velocities change, to first order.
  void follow(const Vector& change, std::vector<PairContacts>& contacts) const;

  /// ½ Vᵀ M V, as its sum.
  PerBody kineticEnergy(const Vector& V) const;

 private:
  /// A point's impulse along one direction: `push` at V, minus `factor` times the change of its speed along it.
  struct Row {
    const PointContact* point;
    Vector3d direction;
    double factor;  // [kg]
    double push;    // [N·s]
  };
  struct PairRows {
    const PairContacts* pair;
    std::vector<Row> rows;
  };
  std::vector<PairRows> rowsOf(const Vector& V, const std::vector<PairContacts>& contacts,
                               const std::vector<PairContacts>& damped) const;

  Vector timesMass(const Vector& V) const;
  PerBody dot(const Vector& a, const Vector& b) const;
  /// Shifts the velocities of bodies that touch no fixed ones so that their momentum is that of V0. Without this, the
  /// rounding of a solve with stiff contact changes it.
  void keepMomentum(BodyGroups groups, const Vector& V0, Vector& V) const;

  Eigen::Matrix<double, 6, 1> of(const Vector& V, int body) const;
  Vector3d relativeVelocity(const Vector& V, const PairContacts& pair, const PointContact& point) const;

  const RigidWorld& world_;
  const double duration_;
  std::vector<int> offset_;        // of a body's first unknown; -1 if it is fixed
  std::vector<Matrix3d> inertia_;  // per body, O's axes
  std::vector<Matrix3d> R_OB_;     // at the start
  int size_ = 0;
};

}  // namespace sdf_ccd
