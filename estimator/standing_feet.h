#pragma once
/// The feet that stand, and what they say about the trunk as long as they stay where they are. Pure: no heap
/// after construction. Trunk axes: x forward, y left, z up, origin in the middle of the hips.
#include <Eigen/Geometry>
#include <vector>

#include "robots/robot_config.h"
#include "signals/joint_state.h"

namespace sprung {

struct StandingFoot {
  Eigen::Vector3d in_trunk_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();     ///< as seen from the trunk
  Eigen::Vector3d link_rate_rad_s = Eigen::Vector3d::Zero();  ///< of the link that it is on, from the trunk
  double radius_m = 0.0;
  double load_N = 0.0;  ///< estimated, along trunk z
  double weight = 0.0;  ///< how much it counts, 0..1; 0: it does not stand
};

class StandingFeet {
 public:
  explicit StandingFeet(const std::vector<LegConfig>& legs);

  void reset() noexcept;
  /// @param legs one for each leg, as last_link_rates_rad_s (hip axes). A foot counts for as much as its
  /// contact is sure and loaded, and fully only some time after its touchdown, in which it slides and
  /// bounces.
  void update(const std::vector<EstimatedLeg>& legs,
              const std::vector<Eigen::Vector3d>& last_link_rates_rad_s, double dt_s) noexcept;

  const std::vector<StandingFoot>& feet() const noexcept { return feet_; }  ///< one for each leg
  double weight() const noexcept { return weight_; }                        ///< sum
  int count() const noexcept;  ///< feet that count for half or more

  /// Of the trunk, from how the feet turn about their middle; what they cannot show (with two feet, turning
  /// about the line between them) is 0. Trunk axes.
  Eigen::Vector3d angular_velocity_rad_s() const noexcept;
  /// Small rotation about world x and y that makes the feet level; what they cannot show is 0.
  Eigen::Vector3d tilt_error_rad(const Eigen::Quaterniond& trunk_to_world) const noexcept;
  /// Of the trunk's origin over the feet; NaN when none stands.
  double height_m(const Eigen::Quaterniond& trunk_to_world) const noexcept;

 private:
  struct Leg {
    Eigen::Vector3d hip_in_trunk_m;
    double loaded_N;       ///< a foot that carries this counts fully
    double radius_m;       ///< of the foot
    double since_s = 0.0;  ///< since touchdown
  };
  void update_foot(Leg& leg, const EstimatedLeg& estimated, const Eigen::Vector3d& link_rate_rad_s,
                   double dt_s, StandingFoot& foot) const noexcept;
  void find_middle() noexcept;

  std::vector<Leg> legs_;
  std::vector<StandingFoot> feet_;
  double weight_ = 0.0;
  Eigen::Vector3d middle_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle_velocity_m_s_ = Eigen::Vector3d::Zero();
};

}  // namespace sprung
