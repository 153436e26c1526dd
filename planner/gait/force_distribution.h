#pragma once
/// Shares the force and torque that a body needs among its standing feet. Pure: no heap, no clock, same bits
/// for the same input.
///
/// Smallest sum of: weighted square of what the wrench lacks, and weight.foot_force times the square of all
/// forces; with every foot between its least and most load and inside its friction cone. Four feet have 12
/// numbers for 6: the last term chooses. Two feet cannot turn the body about the line between them but by
/// pushing sideways (height of the com times force): weights decide how much of that is done. The cone is
/// replaced by the eight-sided pyramid inside it with edges along the axes and diagonals: all of the friction
/// there, 92 % of it between.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/gait/force_distribution_qp.h"

namespace sprung {

/// One foot. Level axes (z up), heading as the caller's.
struct FootLoad {
  Eigen::Vector3d foot_from_com_m = Eigen::Vector3d::Zero();
  double most_N = 0.0;   ///< vertical; ramp it for a foot that has just landed or is about to leave; below 0
                         ///< counts as 0
  double least_N = 0.0;  ///< vertical; more than most_N counts as most_N
  bool stands = false;   ///< else its force is 0 and the rest is not read
};

/// On the body, about its com, level axes. Wanted: what the ground is to give, so weight is in it (+ z).
struct BodyWrench {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_Nm = Eigen::Vector3d::Zero();
};

/// Of squares: force 1/N^2, torque 1/(Nm)^2. Only ratios matter.
struct ForceWeights {
  double horizontal_force = 0.1;
  double vertical_force = 1.0;
  double roll_pitch_torque = 20.0;  ///< at 0.22 m from the com a foot's vertical force then counts equally in
                                    ///< both
  double yaw_torque = 1.0;
  double foot_force = 1e-4;  ///< of each foot's force; lets the wrench lack a few tenths of a per mille
};

enum class ForceStatus {
  kExact,    ///< the wrench is reached (weighted error at most ForceDistribution::kExactWithin_N)
  kBounded,  ///< out of reach of these feet: the nearest one in the sense of the weights
  kNoFeet,   ///< none stands: all forces 0
  kInvalid,  ///< an input that is not finite, or more than kMostFeet feet: all forces 0
};

struct DistributedForce {
  static constexpr int kMostFeet = 4;
  std::array<Eigen::Vector3d, kMostFeet> ground_on_foot_N{};  ///< in the order of the feet given
  BodyWrench reached;                                         ///< what these forces do to the body
  ForceStatus status = ForceStatus::kNoFeet;
};

class ForceDistribution {
 public:
  /// floor_friction: of the cones, > 0. Weights > 0.
  explicit ForceDistribution(double floor_friction, const ForceWeights& weights = {}) noexcept;

  /// Holds until the next call.
  const DistributedForce& solve(const BodyWrench& wanted, const std::vector<FootLoad>& feet) noexcept;

  static constexpr double kExactWithin_N = 0.5;

 private:
  static constexpr int kSides = 8;  ///< of the pyramid in place of the cone

  void clear(ForceStatus status) noexcept;
  int take_feet(const std::vector<FootLoad>& feet) noexcept;
  void pose(const BodyWrench& wanted) noexcept;
  void add_rows(int first, double least_N, double most_N) noexcept;
  void keep(const ForceDistributionQp::Vector& forces, const std::vector<FootLoad>& feet) noexcept;
  void compare(const BodyWrench& wanted) noexcept;

  double friction_;
  Eigen::Vector3d force_weights_, torque_weights_;
  double foot_force_weight_;
  std::array<Eigen::Vector3d, kSides> sides_;  ///< normals of the pyramid, inward
  /// Feet that stand; forces of others are no variables.
  std::array<int, DistributedForce::kMostFeet> standing_{};
  std::array<Eigen::Matrix3d, DistributedForce::kMostFeet> torque_of_force_m_;  ///< of the feet that stand
  int standing_count_ = 0;
  ForceDistributionQp qp_;
  DistributedForce out_;
};

}  // namespace sprung
