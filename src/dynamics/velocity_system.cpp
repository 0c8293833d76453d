#include "velocity_system.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace sdf_ccd {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kDenseUpTo = 90;  // unknowns; beyond, a sparse solve is faster because of few contacts per body

Vector6d lever(const Vector3d& r, const Vector3d& direction) {
  Vector6d j;
  j << direction, r.cross(direction);
  return j;
}

/// Blocks of one pair: shell-shell, shell-field, field-field; and the impulses on both at V.
struct PairBlocks {
  Matrix6d pp = Matrix6d::Zero(), pf = Matrix6d::Zero(), ff = Matrix6d::Zero();
  Vector6d push_P = Vector6d::Zero(), push_F = Vector6d::Zero();

  void add(const Vector6d& j_P, const Vector6d& j_F, double factor, double push) {
    push_P += push * j_P;
    push_F += push * j_F;
    pp += factor * j_P * j_P.transpose();
    pf -= factor * j_P * j_F.transpose();
    ff += factor * j_F * j_F.transpose();
  }
};

/// A symmetric matrix of 6×6 blocks, solved densely or sparsely by its size.
class BlockMatrix {
 public:
  explicit BlockMatrix(int size) : size_(size) {
    if (isDense()) dense_ = Eigen::MatrixXd::Zero(size, size);
  }
  void add(int row, int column, const Matrix6d& block) {
    if (isDense()) {
      dense_.block<6, 6>(row, column) += block;
      return;
    }
    for (int i = 0; i < 6; ++i) {
      for (int k = 0; k < 6; ++k) entries_.emplace_back(row + i, column + k, block(i, k));
    }
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    if (isDense()) return dense_.ldlt().solve(right);
    Eigen::SparseMatrix<double> sparse(size_, size_);
    sparse.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(sparse).solve(right);
  }

 private:
  bool isDense() const { return size_ <= kDenseUpTo; }

  int size_;
  Eigen::MatrixXd dense_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

VelocitySystem::VelocitySystem(const RigidWorld& world, const std::vector<BodyState>& states, double duration)
    : world_(world), duration_(duration), offset_(states.size(), -1) {
  for (std::size_t b = 0; b < states.size(); ++b) {
    R_OB_.push_back(states[b].X_OB.linear());
    inertia_.push_back(R_OB_[b] * world.bodies[b].inertia * R_OB_[b].transpose());
    if (world.bodies[b].fixed) continue;
    offset_[b] = size_;
    size_ += 6;
  }
}

VelocitySystem::Vector VelocitySystem::velocitiesOf(const std::vector<BodyState>& states) const {
  Vector V(size_);
  for (std::size_t b = 0; b < states.size(); ++b) {
    if (offset_[b] >= 0) V.segment<6>(offset_[b]) << states[b].velocity, R_OB_[b] * states[b].spin_B;
  }
  return V;
}

void VelocitySystem::setVelocities(const Vector& V, std::vector<BodyState>& states) const {
  for (std::size_t b = 0; b < states.size(); ++b) {
    if (offset_[b] < 0) continue;
    states[b].velocity = V.segment<3>(offset_[b]);
    states[b].spin_B = R_OB_[b].transpose() * V.segment<3>(offset_[b] + 3);
  }
}

VelocitySystem::Vector VelocitySystem::withoutContact(const std::vector<BodyState>& states) const {
  Vector V = velocitiesOf(states);
  for (std::size_t b = 0; b < states.size(); ++b) {
    if (offset_[b] < 0) continue;
    const Wrench& applied = world_.bodies[b].applied;
    V.segment<3>(offset_[b]) += duration_ * (world_.gravity + applied.force / world_.bodies[b].mass);
    V.segment<3>(offset_[b] + 3) += duration_ * inertia_[b].ldlt().solve(applied.torque);
  }
  return V;
}

VelocitySystem::Vector VelocitySystem::timesMass(const Vector& V) const {
  Vector result(size_);
  for (std::size_t b = 0; b < offset_.size(); ++b) {
    if (offset_[b] < 0) continue;
    result.segment<3>(offset_[b]) = world_.bodies[b].mass * V.segment<3>(offset_[b]);
    result.segment<3>(offset_[b] + 3) = inertia_[b] * V.segment<3>(offset_[b] + 3);
  }
  return result;
}

PerBody VelocitySystem::dot(const Vector& a, const Vector& b) const {
  PerBody result = PerBody::Zero(offset_.size());
  for (std::size_t i = 0; i < offset_.size(); ++i) {
    if (offset_[i] >= 0) result[i] = a.segment<6>(offset_[i]).dot(b.segment<6>(offset_[i]));
  }
  return result;
}

PerBody VelocitySystem::kineticEnergy(const Vector& V) const {
  return 0.5 * dot(V, timesMass(V));
}

Vector6d VelocitySystem::of(const Vector& V, int body) const {
  return offset_[body] < 0 ? Vector6d(Vector6d::Zero()) : Vector6d(V.segment<6>(offset_[body]));
}

Vector3d VelocitySystem::relativeVelocity(const Vector& V, const PairContacts& pair, const PointContact& point) const {
  const Vector6d P = of(V, pair.shell_body), F = of(V, pair.field_body);
  return P.head<3>() + P.tail<3>().cross(point.r_P) - F.head<3>() - F.tail<3>().cross(point.r_F);
}

PerBody VelocitySystem::merit(const Vector& V, const Vector& V0, const std::vector<PairContacts>& contacts,
                              const std::vector<PairContacts>& damped) const {
  PerBody merit = kineticEnergy(V - V0);
  for (const PairContacts& pair : contacts) {
    double& value = merit[bodyOf(world_, pair)];
    for (const PointContact& point : pair.points) value += 0.5 * point.stiffness * point.gap * point.gap;
  }
  for (const PairContacts& pair : damped) {
    double& value = merit[bodyOf(world_, pair)];
    for (const PointContact& point : pair.points) {
      value += 0.5 * duration_ * point.damping * relativeVelocity(V, pair, point).squaredNorm();
    }
  }
  return merit;
}

std::vector<VelocitySystem::PairRows> VelocitySystem::rowsOf(const Vector& V, const std::vector<PairContacts>& contacts,
                                                             const std::vector<PairContacts>& damped) const {
  std::vector<PairRows> all;
  for (const PairContacts& pair : contacts) {
    all.push_back({&pair, {}});
    for (const PointContact& point : pair.points) {
      if (point.gap == 0.0) continue;
      const double k = duration_ * point.stiffness;
      all.back().rows.push_back({&point, point.slope, duration_ * k, -k * point.gap});
    }
  }
  for (const PairContacts& pair : damped) {
    all.push_back({&pair, {}});
    for (const PointContact& point : pair.points) {
      const double d = duration_ * point.damping;
      if (d == 0.0) continue;
      const Vector3d slide = relativeVelocity(V, pair, point);
      for (int axis = 0; axis < 3; ++axis) {
        all.back().rows.push_back({&point, Vector3d::Unit(axis), d, -d * slide[axis]});
      }
    }
  }
  return all;
}

VelocitySystem::Solution VelocitySystem::solve(const Vector& V, const Vector& V0,
                                               const std::vector<PairContacts>& contacts,
                                               const std::vector<PairContacts>& damped) const {
  BlockMatrix A(size_);
  Vector downhill = timesMass(V0 - V);
  for (std::size_t b = 0; b < offset_.size(); ++b) {
    if (offset_[b] < 0) continue;
    Matrix6d mass = Matrix6d::Zero();
    mass.topLeftCorner<3, 3>() = world_.bodies[b].mass * Matrix3d::Identity();
    mass.bottomRightCorner<3, 3>() = inertia_[b];
    A.add(offset_[b], offset_[b], mass);
  }
  const std::vector<PairRows> all = rowsOf(V, contacts, damped);
  for (const auto& [pair, rows] : all) {
    PairBlocks blocks;
    for (const Row& row : rows) {
      blocks.add(lever(row.point->r_P, row.direction), lever(row.point->r_F, row.direction), row.factor, row.push);
    }
    const int p = offset_[pair->shell_body], f = offset_[pair->field_body];
    if (p >= 0) {
      A.add(p, p, blocks.pp);
      downhill.segment<6>(p) += blocks.push_P;
    }
    if (f >= 0) {
      A.add(f, f, blocks.ff);
      downhill.segment<6>(f) -= blocks.push_F;
    }
    if (p >= 0 && f >= 0) {
      A.add(p, f, blocks.pf);
      A.add(f, p, blocks.pf.transpose());
    }
  }

  Solution solution;
  BodyGroups groups(world_);
  groups.join(contacts);
  groups.join(damped);
  Vector end = V + A.solve(downhill);
  keepMomentum(groups, V0, end);
  solution.change = end - V;
  solution.decrease = dot(downhill, solution.change);
  for (const auto& [pair, rows] : all) {
    for (const Row& row : rows) {
      const double more = row.factor * row.direction.dot(relativeVelocity(solution.change, *pair, *row.point));
      const Vector3d impulse = (row.push - more) * row.direction;
      solution.reaction.add(pair->p_OP, {impulse, row.point->r_P.cross(impulse)});
      solution.reaction.add(pair->p_OF, {-impulse, -row.point->r_F.cross(impulse)});
    }
  }
  return solution;
}

void VelocitySystem::keepMomentum(BodyGroups groups, const Vector& V0, Vector& V) const {
  const PerBody held = groups.touchesFixed();
  PerBody mass = PerBody::Zero(offset_.size());
  Eigen::Array3Xd lost = Eigen::Array3Xd::Zero(3, offset_.size());
  for (std::size_t b = 0; b < offset_.size(); ++b) {
    if (offset_[b] < 0) continue;
    const int group = groups.first(int(b));
    mass[group] += world_.bodies[b].mass;
    lost.col(group) += world_.bodies[b].mass * (V0 - V).segment<3>(offset_[b]).array();
  }
  for (std::size_t b = 0; b < offset_.size(); ++b) {
    const int group = groups.first(int(b));
    if (offset_[b] >= 0 && held[group] == 0.0) V.segment<3>(offset_[b]).array() += lost.col(group) / mass[group];
  }
}

void VelocitySystem::follow(const Vector& change, std::vector<PairContacts>& contacts) const {
  for (PairContacts& pair : contacts) {
    for (PointContact& point : pair.points) {
      if (point.depth == 0.0 || point.gap != point.depth) continue;
      point.depth += duration_ * point.slope.dot(relativeVelocity(change, pair, point));
      point.depth = point.gap = std::min(point.depth, 0.0);
    }
  }
}

}  // namespace sdf_ccd
