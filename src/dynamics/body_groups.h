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
  explicit BodyGroups(const RigidWorld& world) : world_(&world), parent_(world.bodies.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void join(const std::vector<PairContacts>& contacts) {
    for (const PairContacts& pair : contacts) {
      if (world_->bodies[pair.shell_body].fixed || world_->bodies[pair.field_body].fixed) continue;
      parent_[first(pair.shell_body)] = first(pair.field_body);
    }
  }

  /// Of each group, at one of its bodies; zero at the others.
  PerBody sums(const PerBody& values) {
    PerBody result = PerBody::Zero(values.size());
    for (Eigen::Index b = 0; b < values.size(); ++b) result[first(int(b))] += values[b];
    return result;
  }

 private:
  int first(int b) {
    while (parent_[b] != b) b = parent_[b] = parent_[parent_[b]];
    return b;
  }

  const RigidWorld* world_;
  std::vector<int> parent_;
};

}  // namespace sdf_ccd
