#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd {

/// Mass, centre of mass and inertia of a rigid body.
struct MassProperties {
  double mass = 0.0;                    ///< [kg]
  Vector3d center = Vector3d::Zero();   ///< centre of mass [m], in the geometry's frame
  Matrix3d inertia = Matrix3d::Zero();  ///< about the centre of mass, in the geometry's axes [kg·m²]
};

/// Mass properties of the solid inside a closed mesh, by the divergence theorem: the signed sum over the tetrahedra of
/// its triangles and the centre of its box (so that a mesh far from its frame's origin loses no digits).
///
/// @param density  [kg/m³], finite and positive.
/// @throws std::invalid_argument for a mesh that encloses no positive volume (open, flat, inside out), or a density
/// that is not valid. An open mesh that encloses volume is treated as if the tetrahedra closed it: check
/// MeshQuality::boundary_edges.
MassProperties massProperties(const TriangleMesh& mesh, double density);

/// Mass properties of a primitive, in closed form.
/// @throws std::invalid_argument for a half-space, whose mass is infinite.
MassProperties massProperties(const Primitive& primitive, double density);

/// Throws std::invalid_argument, with the value, unless a rigid body can have this mass and inertia: finite, positive,
/// symmetric, and principal moments of which none exceeds the sum of the others.
void validateInertia(double mass, const Matrix3d& inertia);

/// Collision geometry in the body's frame B, whose origin is the centre of mass. Several bodies may share it.
struct CollisionShape;

/// Builds field and shell of a shape from a closed mesh. The field has exact samples in the whole solid, so that deep
/// overlaps have a depth.
/// @param mesh_B  about the centre of mass; its components are oriented outward.
/// @throws std::invalid_argument if field or shell cannot be built.
std::shared_ptr<const CollisionShape> makeShape(const TriangleMesh& mesh_B, FieldOptions field,
                                                const ShellOptions& shell);

/// The same for a primitive: the field is exact. A half-space has no shell.
std::shared_ptr<const CollisionShape> makeShape(const Primitive& primitive, const ShellOptions& shell);

/// A rigid body.
struct RigidBody {
  std::string name;
  std::shared_ptr<const CollisionShape> shape;
  double mass = 0.0;                    ///< [kg]; not read if fixed
  Matrix3d inertia = Matrix3d::Zero();  ///< about B's origin, in B's axes [kg·m²]; not read if fixed
  bool fixed = false;                   ///< never moves
  Wrench applied;                       ///< user force, in the scene's axes, about B's origin [N, N·m]
};

/// Pose and velocity of a body, in the scene's frame O.
struct BodyState {
  Isometry3d X_OB = Isometry3d::Identity();
  Vector3d velocity = Vector3d::Zero();  ///< of B's origin [m/s], O's axes
  Vector3d spin_B = Vector3d::Zero();    ///< angular velocity [rad/s], B's axes
};

/// Rigid bodies and the forces on them. The scene's frame O has the axes of the world and an origin near the bodies, so
/// that contact far from the world's origin is as accurate as near it.
struct RigidWorld {
  std::vector<RigidBody> bodies;
  Vector3d origin_W = Vector3d::Zero();          ///< of O [m]
  Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< [m/s²]
  ContactOptions contact;
  double chord_tolerance = 1e-3;  ///< deviation of a point's arc from its chords, as a share of its body's radius
};

/// A simulation cannot go on: which body, at which step, why.
class SimulationError : public std::runtime_error {
 public:
  /// Joins the three to one sentence.
  SimulationError(const std::string& body, long step, const std::string& reason)
      : std::runtime_error("body `" + body + "`, step " + std::to_string(step) + ": " + reason) {}
};

/// Throws SimulationError (step 0) that names the first body that cannot be simulated, or std::invalid_argument for
/// options that are not valid: a mass, inertia, force or state that is not finite or not positive, a body without field
/// and shell, a moving half-space.
void validate(const RigidWorld& world, const std::vector<BodyState>& states);

/// ½ m v² + ½ ω·Iω [J]; 0 for a fixed body.
double kineticEnergy(const RigidBody& body, const BodyState& state);

/// Momentum [N·s] and angular momentum about O's origin [N·m·s] of all bodies that move.
Wrench totalMomentum(const RigidWorld& world, const std::vector<BodyState>& states);

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
