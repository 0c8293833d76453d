#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/dynamics/rigid_world.h"

namespace sdf_ccd {

/// How contact forces enter a time step.
enum class Scheme {
  /// The paper's §4: symplectic Euler under the force and torque averaged over the last step's continuous contact
  /// (Eq. 8-11). A persistent contact (s = ωΔt, damping ratio ζ) is stable only for s/4 < ζ < 1/s (design §3.10).
  kContinuous,
  /// The scheme that the paper compares with: symplectic Euler under penalty and damping forces at the sampled pose;
  /// stable for s² + 4ζs < 4.
  kDiscrete,
  /// Ours: backward Euler by Newton's method on the 6×6 stiffness and damping blocks of all contact points, contacts
  /// found continuously. A persistent contact is stable at any step. A step whose energy would grow is halved. It costs
  /// accuracy: at ζ = 0 a contact oscillation is damped as by ζ ≈ s/2, so impacts that last few steps lose most of
  /// their energy. Momentum is conserved to rounding, angular momentum of oblique impacts only to first order in the
  /// step, as moments are those at its end. Needs field normals.
  kImplicit
};

/// "continuous", "discrete" or "implicit".
const char* toString(Scheme scheme);

/// @throws std::invalid_argument for any other name.
Scheme schemeOf(const std::string& name);

/// Measurements at the end of a step. Anything between two ends, such as a deeper point, is not included.
struct StepRecord {
  long step = 0;
  double time = 0.0;            ///< [s]
  double kinetic = 0.0;         ///< [J]
  double potential = 0.0;       ///< of gravity and applied forces, about O's origin, minus the work of torques [J]
  double elastic = 0.0;         ///< of contact [J]
  Wrench momentum;              ///< of all moving bodies, about O's origin [N·s, N·m·s]
  double reaction_error = 0.0;  ///< |Σ contact impulses or moments on all bodies| / Σ |parts|; 0 up to rounding
  double energy_excess = 0.0;   ///< kImplicit: growth of energy that halving the step did not remove [J]
  double deepest = 0.0;         ///< contact point [m]
  int contacts = 0;             ///< points inside a field
  int solves = 0;               ///< kImplicit: linear systems solved
  double run_time = 0.0;        ///< [s]

  /// Of all kinds together [J].
  double energy() const { return kinetic + potential + elastic; }
};

class Integrator;
struct StepReport;

/// Simulates a world in time steps. Never returns NaN: if a value cannot be computed, it throws SimulationError.
class Simulation {
 public:
  /// @param step  [s].
  /// @throws SimulationError, std::invalid_argument as validate() does; also for a step that is not finite or positive,
  /// and for a body whose position, energy or momentum is out of range.
  Simulation(RigidWorld world, std::vector<BodyState> states, Scheme scheme, double step);

  /// Moved, not copied.
  ///@{
  Simulation(Simulation&& other) noexcept;
  Simulation& operator=(Simulation&& other) noexcept;
  ///@}
  ~Simulation();

  /// @throws SimulationError if a body's state is out of range; states() and last() are then unchanged.
  const StepRecord& advance();

  /// The world that is simulated.
  const RigidWorld& world() const { return *world_; }
  /// Per body: its state at the end of the last step.
  const std::vector<BodyState>& states() const { return states_; }
  /// The record of the last step; before the first one, of the start.
  const StepRecord& last() const { return record_; }

 private:
  StepRecord measured(const std::vector<BodyState>& states, long step) const;
  double workOfTorques(const std::vector<BodyState>& before, const std::vector<BodyState>& after) const;

  std::unique_ptr<const RigidWorld> world_;  // the integrator refers to it
  std::vector<BodyState> states_;
  std::unique_ptr<Integrator> integrator_;
  double step_;
  double torque_work_ = 0.0;  // so far [J]
  std::unique_ptr<StepReport> report_;
  StepRecord record_;
};

/// A scene that is ready to run.
struct SimulationSetup {
  RigidWorld world;
  std::vector<BodyState> states;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;  ///< per body, frame B, for display; null for a half-space
  std::vector<std::string> warnings;  ///< bodies whose meshes are not closed, so that their inside is ambiguous
  Scheme scheme = Scheme::kImplicit;
  double step = 1e-3;     ///< [s]
  double duration = 1.0;  ///< [s]
};

/// Reads a scene in YAML, as the commented ones in config/scenes: integrator, step, duration, gravity, contact, shapes,
/// bodies. Fields and shells of bodies that share a shape are built once.
///
/// Poses are given in the frame `origin` (default: the world's). If the first moving body is farther than 100 m from
/// it, the scene's frame O is moved near that body, by whole metres.
/// @param text       the file's content.
/// @param directory  mesh files are looked up from here.
/// @throws std::runtime_error naming line and key, or the body or shape, and the reason; also for a moving body with an
/// open mesh, unless mass and inertia are given.
SimulationSetup parseSimulation(const std::string& text, const std::string& directory);

/// The same for a file; errors begin with its name.
SimulationSetup loadSimulation(const std::string& path);

}  // namespace sdf_ccd
