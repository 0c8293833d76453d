#pragma once

#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "end_contacts.h"

namespace sdf_ccd {

/// A number per body, such as its share of an energy.
using PerBody = Eigen::ArrayXd;

/// The body that a pair's energy is counted with: one that moves.
inline int bodyOf(const RigidWorld& world, const PairContacts& pair) {
  return world.bodies[pair.shell_body].fixed ? pair.field_body : pair.shell_body;
}

/// Groups of bodies that act on each other, directly or through others that move, so that what is small beside the
/// energies of bodies elsewhere is not lost.
class BodyGroups {
 public:
  explicit BodyGroups(const RigidWorld& world)
      : world_(&world), parent_(world.bodies.size()), held_(PerBody::Zero(world.bodies.size())) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void join(const std::vector<PairContacts>& contacts) {
    for (const PairContacts& pair : contacts) {
      if (world_->bodies[pair.shell_body].fixed || world_->bodies[pair.field_body].fixed) {
        held_[bodyOf(*world_, pair)] = 1.0;
      } else {
        parent_[first(pair.shell_body)] = first(pair.field_body);
      }
    }
  }

  /// The body that stands for a body's group.
  int first(int b) {
    while (parent_[b] != b) b = parent_[b] = parent_[parent_[b]];
    return b;
  }

  /// Of each group, at its first(); zero at the others.
  PerBody sums(const PerBody& values) {
    PerBody result = PerBody::Zero(values.size());
    for (Eigen::Index b = 0; b < values.size(); ++b) result[first(int(b))] += values[b];
    return result;
  }

  /// Whether a body's group touches fixed bodies, so that its momentum may change; at its first(), as a number above 0.
  PerBody touchesFixed() { return sums(held_); }

 private:
  const RigidWorld* world_;
  std::vector<int> parent_;
  PerBody held_;  // 1 for bodies that touch fixed ones
};

}  // namespace sdf_ccd
