#include "planner/gait/force_distribution.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {

static_assert(ForceDistributionQp::kVariables == 3 * DistributedForce::kMostFeet);

double most_N(const FootLoad& foot) noexcept { return std::max(0.0, foot.most_N); }
double least_N(const FootLoad& foot) noexcept { return std::clamp(foot.least_N, 0.0, most_N(foot)); }

bool load_is_finite(const FootLoad& foot) noexcept {
  return !foot.stands ||
         (foot.foot_from_com_m.allFinite() && std::isfinite(foot.most_N) && std::isfinite(foot.least_N));
}

bool valid(const BodyWrench& wanted, const std::vector<FootLoad>& feet) noexcept {
  return wanted.force_N.allFinite() && wanted.torque_Nm.allFinite() &&
         feet.size() <= DistributedForce::kMostFeet && std::all_of(feet.begin(), feet.end(), load_is_finite);
}

/// r x as a matrix.
Eigen::Matrix3d cross(const Eigen::Vector3d& r) noexcept {
  Eigen::Matrix3d matrix;
  matrix << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return matrix;
}

}  // namespace

ForceDistribution::ForceDistribution(double floor_friction, const ForceWeights& weights) noexcept
    : friction_(floor_friction),
      force_weights_(weights.horizontal_force, weights.horizontal_force, weights.vertical_force),
      torque_weights_(weights.roll_pitch_torque, weights.roll_pitch_torque, weights.yaw_torque),
      foot_force_weight_(weights.foot_force) {
  static_assert(ForceDistributionQp::kMostRows == (kSides + 2) * DistributedForce::kMostFeet);
  const double inside = friction_ *
                        std::cos(kPi / kSides);  // middle of a side, its corners being on the cone
  for (int side = 0; side < kSides; ++side) {
    const double angle_rad = (2 * side + 1) * kPi / kSides;
    sides_[side] = {-std::cos(angle_rad), -std::sin(angle_rad), inside};
  }
  clear(ForceStatus::kNoFeet);
}

const DistributedForce& ForceDistribution::solve(const BodyWrench& wanted,
                                                 const std::vector<FootLoad>& feet) noexcept {
  clear(ForceStatus::kNoFeet);
  if (!valid(wanted, feet)) {
    clear(ForceStatus::kInvalid);
    return out_;
  }
  if (take_feet(feet) == 0) return out_;
  pose(wanted);
  for (int i = 0; i < standing_count_; ++i) {
    const FootLoad& foot = feet[standing_[i]];
    add_rows(3 * i, least_N(foot), most_N(foot));
  }
  qp_.solve();
  if (!qp_.solution().allFinite()) {  // numbers so large that they overflowed
    clear(ForceStatus::kInvalid);
    return out_;
  }
  keep(qp_.solution(), feet);
  compare(wanted);
  return out_;
}

void ForceDistribution::clear(ForceStatus status) noexcept {
  standing_count_ = 0;
  out_.ground_on_foot_N.fill(Eigen::Vector3d::Zero());
  out_.reached = BodyWrench{};
  out_.status = status;
}

int ForceDistribution::take_feet(const std::vector<FootLoad>& feet) noexcept {
  for (int i = 0; i < static_cast<int>(feet.size()); ++i) {
    if (!feet[i].stands) continue;
    torque_of_force_m_[standing_count_] = cross(feet[i].foot_from_com_m);
    standing_[standing_count_++] = i;
  }
  return standing_count_;
}

/// Cost and gradient of the standing feet's forces, the former's lower triangle by blocks of two feet.
void ForceDistribution::pose(const BodyWrench& wanted) noexcept {
  ForceDistributionQp::Matrix cost;
  ForceDistributionQp::Vector gradient;
  const Eigen::Vector3d wish = force_weights_.cwiseProduct(wanted.force_N);
  const Eigen::Vector3d torque_wish = torque_weights_.cwiseProduct(wanted.torque_Nm);
  for (int i = 0; i < standing_count_; ++i) {
    const Eigen::Matrix3d turning = torque_of_force_m_[i].transpose() * torque_weights_.asDiagonal();
    const Eigen::Index row = Eigen::Index{3} * i;
    gradient.segment<3>(row) = -(wish + torque_of_force_m_[i].transpose() * torque_wish);
    for (int k = 0; k <= i; ++k) {
      auto block = cost.block<3, 3>(row, Eigen::Index{3} * k);
      block = turning * torque_of_force_m_[k];
      block.diagonal() += force_weights_;
    }
    cost.diagonal().segment<3>(row).array() += foot_force_weight_;
  }
  qp_.begin(cost, gradient, 3 * standing_count_);
}

void ForceDistribution::add_rows(int first, double least_N, double most_N) noexcept {
  qp_.add({first, Eigen::Vector3d::UnitZ(), least_N});
  qp_.add({first, -Eigen::Vector3d::UnitZ(), -most_N});
  for (const Eigen::Vector3d& side : sides_) qp_.add({first, side, 0.0});
}

/// Inside bounds and cone to the last digit, and also should the solver ever have stopped half-way.
void ForceDistribution::keep(const ForceDistributionQp::Vector& forces,
                             const std::vector<FootLoad>& feet) noexcept {
  for (int i = 0; i < standing_count_; ++i) {
    const FootLoad& foot = feet[standing_[i]];
    Eigen::Vector3d& force = out_.ground_on_foot_N[standing_[i]];
    force = forces.segment<3>(Eigen::Index{3} * i);
    force.z() = std::clamp(force.z(), least_N(foot), most_N(foot));
    const double horizontal = force.head<2>().norm();
    const double most = friction_ * force.z();
    if (horizontal > most) force.head<2>() *= most / horizontal;
  }
}

void ForceDistribution::compare(const BodyWrench& wanted) noexcept {
  BodyWrench& reached = out_.reached;
  for (int i = 0; i < standing_count_; ++i) {
    const Eigen::Vector3d& force_N = out_.ground_on_foot_N[standing_[i]];
    reached.force_N += force_N;
    reached.torque_Nm += torque_of_force_m_[i] * force_N;
  }
  const Eigen::Vector3d force_N = wanted.force_N - reached.force_N;
  const Eigen::Vector3d torque_Nm = wanted.torque_Nm - reached.torque_Nm;
  const double lacking = force_N.dot(force_weights_.cwiseProduct(force_N)) +
                         torque_Nm.dot(torque_weights_.cwiseProduct(torque_Nm));
  const bool exact = lacking <= kExactWithin_N * kExactWithin_N;
  out_.status = exact ? ForceStatus::kExact : ForceStatus::kBounded;
}

}  // namespace sprung
