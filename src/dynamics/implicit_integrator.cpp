#include <algorithm>
#include <limits>

#include "dynamics/collision_shape.h"
#include "explicit_step.h"
#include "velocity_system.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxSolves = 20;
constexpr int kMaxShortenings = 6;         // of one Newton step
constexpr int kMaxHalvings = 8;            // of the time step
constexpr double kPassed = 0.1;            // distance behind a plane, relative to the smaller body's radius
constexpr double kConverged = 1e-12;       // remaining gain of a Newton step, relative to the energies
constexpr double kEnergyRounding = 1e-10;  // relative to the energies
constexpr double kPositionRounding = 4.0 * std::numeric_limits<double>::epsilon();

/// Backward Euler (see VelocitySystem). Because the energy of a compressed contact is convex in the penetration, a step
/// to the minimum of Φ never ends with more energy than it began with: ΔU ≤ ∇U(x')·Δt v' = −(M Δv)·v' − Δt v'·D v'.
/// This does not hold for rotations and fields that are not convex, so the energy is checked, and the step is halved if
/// it grew.
///
/// A body in free flight falls by the midpoint of its velocities, which is exact; one in contact by the velocity at
/// the end, which the proof needs.
class ImplicitIntegrator : public Integrator {
 public:
  explicit ImplicitIntegrator(const RigidWorld& world)
      : world_(world), search_(world), groups_(world), touched_(world.bodies.size(), false) {}

  void advance(double duration, long step, std::vector<BodyState>& states, StepReport& report) override {
    report = {};
    if (!endsAt(motion_, states)) contactsAtRest(world_, states, search_, contacts_);
    advancePart(duration, step, 0, states, report);
    measure(contacts_, report);
  }

 private:
  void advancePart(double duration, long step, int halvings, std::vector<BodyState>& states, StepReport& report) {
    const std::vector<BodyState> start = states;
    const std::vector<PairContacts> contacts_at_start = contacts_;
    Reaction reaction;
    const bool solved = solveStep(duration, step, states, reaction, report);
    const double grown = growth(start, contacts_at_start, duration, states);
    if (halvings < kMaxHalvings && (grown > 0.0 || (!solved && pointsPass()))) {
      const std::vector<BodyState> whole = states;
      const std::vector<PairContacts> contacts_of_whole = contacts_;
      const StepMotion motion_of_whole = motion_;
      StepReport halved = report;
      states = start;
      contacts_ = contacts_at_start;
      advancePart(0.5 * duration, step, halvings + 1, states, halved);
      advancePart(0.5 * duration, step, halvings + 1, states, halved);
      // Points that pass are better than halves that gain energy.
      if (grown > 0.0 || halved.energy_excess == report.energy_excess) {
        report = halved;
        return;
      }
      states = whole;
      contacts_ = contacts_of_whole;
      motion_ = motion_of_whole;
      report.solves = halved.solves;
    }
    report.energy_excess += grown;
    report.reaction += reaction;
  }

  /// Growth of energy during a step, of the groups of bodies where it is more than rounding [J].
  double growth(const std::vector<BodyState>& start, const std::vector<PairContacts>& contacts_at_start,
                double duration, const std::vector<BodyState>& end) {
    const PerBody elastic_at_start = elasticEnergies(contacts_at_start), elastic_at_end = elasticEnergies(contacts_);
    PerBody energies = elastic_at_start + elastic_at_end, growth = elastic_at_end - elastic_at_start;
    for (std::size_t b = 0; b < end.size(); ++b) {
      const RigidBody& body = world_.bodies[b];
      if (body.fixed) continue;
      const double before = kineticEnergy(body, start[b]), after = kineticEnergy(body, end[b]);
      const Vector3d moved = end[b].X_OB.translation() - start[b].X_OB.translation();
      const Vector3d rotated = duration * (start[b].X_OB.linear() * end[b].spin_B);
      const double work =
          (body.mass * world_.gravity + body.applied.force).dot(moved) + body.applied.torque.dot(rotated);
      energies[b] += before + after + std::abs(work);
      growth[b] += after - before - work;
    }
    const PerBody sums = groups_.sums(growth);
    const PerBody tolerance = kEnergyRounding * energies + roundings(contacts_at_start) + roundings(contacts_);
    return (sums > groups_.sums(tolerance)).select(sums, 0.0).sum();
  }

  /// Rounding of elastic energies: contact forces times that of positions. It exceeds the energies in stiff contact.
  PerBody roundings(const std::vector<PairContacts>& contacts) const {
    PerBody result = PerBody::Zero(world_.bodies.size());
    for (const PairContacts& pair : contacts) {
      const double distances = pair.p_OP.norm() + pair.p_OF.norm();
      for (const PointContact& point : pair.points) {
        result[bodyOf(world_, pair)] -=
            kPositionRounding * (distances + point.r_P.norm()) * point.stiffness * point.depth;
      }
    }
    return result;
  }

  PerBody elasticEnergies(const std::vector<PairContacts>& contacts) const {
    PerBody energies = PerBody::Zero(world_.bodies.size());
    for (const PairContacts& pair : contacts) energies[bodyOf(world_, pair)] += elasticEnergy(pair);
    return energies;
  }

  /// Whether points pass through a solid: they end far behind the planes that hold them. Not known of a motion of more
  /// than a radian, where planes say little.
  bool pointsPass() const {
    if (motion_.times.size() > 2) return false;
    for (const PairContacts& pair : contacts_) {
      const double size = std::min(world_.bodies[pair.shell_body].shape->ball.radius,
                                   world_.bodies[pair.field_body].shape->ball.radius);
      for (const PointContact& point : pair.points) {
        if (point.depth - point.gap > kPassed * size) return true;
      }
    }
    return false;
  }

  /// One step to the minimum of Φ, from `states`. Leaves the contacts at its end in contacts_, the motion in motion_.
  /// False if it stops before a minimum.
  bool solveStep(double duration, long step, std::vector<BodyState>& states, Reaction& reaction, StepReport& report) {
    const std::vector<BodyState> start = states;
    const VelocitySystem system(world_, start, duration);
    const Vector V0 = system.withoutContact(start);
    // The energy of one step of gravity keeps the scale of a body at rest from being zero.
    const PerBody scale = system.kineticEnergy(V0) + system.kineticEnergy(V0 - system.velocitiesOf(start));
    std::vector<PairContacts> damped;
    const auto move = [&](const Vector& V) {
      states = start;
      system.setVelocities(V, states);
      std::vector<Vector3d> mean;
      for (std::size_t b = 0; b < states.size(); ++b) {
        const RigidBody& body = world_.bodies[b];
        const Vector3d gained = duration * (world_.gravity + body.applied.force / (body.fixed ? 1.0 : body.mass));
        mean.push_back(states[b].velocity - (touched_[b] ? 0.0 : 0.5) * gained);
      }
      drift(world_, mean, duration, step, states, motion_);
    };
    // Finds the contacts at the end of a step with velocities V. True if they touch a body assumed free.
    const auto moveTo = [&](const Vector& V) {
      move(V);
      endContacts(world_, motion_, search_, contacts_);
      bool more = false;
      for (const PairContacts& pair : contacts_) {
        for (const int b : {pair.shell_body, pair.field_body}) {
          more |= !touched_[b];
          touched_[b] = true;
        }
      }
      return more;
    };
    touched_.assign(states.size(), false);
    for (const PairContacts& pair : contacts_) {
      const bool touches = std::any_of(pair.points.begin(), pair.points.end(),
                                       [](const PointContact& point) { return point.depth < 0.0; });
      for (const int b : {pair.shell_body, pair.field_body}) touched_[b] = touched_[b] || touches;
    }
    Vector V = V0;
    if (moveTo(V)) moveTo(V);
    damped = contacts_;
    groups_ = BodyGroups(world_);
    groups_.join(damped);
    PerBody merit = system.merit(V, V0, contacts_, damped);
    for (int i = 0; i < kMaxSolves && !contacts_.empty(); ++i) {
      const VelocitySystem::Solution solution = system.solve(V, V0, contacts_, damped);
      ++report.solves;
      reaction = solution.reaction;
      groups_.join(contacts_);
      if ((groups_.sums(solution.decrease) <= kConverged * groups_.sums(scale + merit)).all()) {
        move(V + solution.change);
        system.follow(solution.change, contacts_);
        return true;
      }
      bool lower = false;
      double share = 1.0;
      for (int k = 0; k <= kMaxShortenings && !lower; ++k, share *= 0.5) {
        const Vector tried = V + share * solution.change;
        const bool other = moveTo(tried);
        const PerBody merit_tried = system.merit(tried, V0, contacts_, damped);
        lower = other || merit_tried.sum() <= merit.sum();
        if (other) {  // another body changes its fall from now on, so Φ is another function
          moveTo(V);
          merit = system.merit(V, V0, contacts_, damped);
        } else if (lower) {
          V = tried;
          merit = merit_tried;
        }
      }
      if (lower) continue;
      moveTo(V);  // on an edge of the field, where its slope jumps, no lower value exists
      return false;
    }
    return contacts_.empty();
  }

  using Vector = VelocitySystem::Vector;

  const RigidWorld& world_;
  ContactSearch search_;
  StepMotion motion_;
  std::vector<PairContacts> contacts_;
  BodyGroups groups_;          // by the contacts of this step
  std::vector<bool> touched_;  // bodies in contact during this step
};

}  // namespace

std::unique_ptr<Integrator> makeImplicitIntegrator(const RigidWorld& world) {
  if (world.contact.normal != NormalSource::kField) {
    throw std::invalid_argument("integrator implicit: contact normals must be the field's");
  }
  return std::make_unique<ImplicitIntegrator>(world);
}

}  // namespace sdf_ccd
