#pragma once
/// Where the trunk is drawn. Pure: the best that the messages of a cycle say of it.
#include <Eigen/Geometry>
#include <optional>
#include <utility>
#include <vector>

#include "model/leg_config.h"

namespace sprung::station {

/// What a pose rests on; `trunk.source` of a frame.
enum class TrunkSource {
  kLegs = 0,        ///< level, the lowest foot on the floor; does not travel, and flight is not seen
  kEstimate = 1,    ///< attitude and height of JOINT_STATE, its velocity summed up; height held in flight
  kSimulation = 2,  ///< SIM_TRUTH
  kOdometry = 3,    ///< BODY_STATE, from where the floor is drawn when it begins
};

/// Of one cycle; NaN where it is not known.
struct TrunkInput {
  Eigen::Vector3d true_position_m;  ///< world
  Eigen::Quaterniond true_attitude;
  Eigen::Quaterniond estimated_attitude;       ///< turns trunk into world axes
  Eigen::Vector3d estimated_velocity_m_s;      ///< trunk axes
  double estimated_height_m = 0.0;             ///< of the middle of the hips over the standing feet
  Eigen::Vector3d odometry_m;                  ///< BODY_STATE's last, its world
  Eigen::Quaterniond odometry_attitude;        ///< trunk into BODY_STATE's world
  std::vector<Eigen::Vector3d> foot_in_hip_m;  ///< of each leg
};

class TrunkPose {
 public:
  explicit TrunkPose(std::vector<LegConfig> legs) : legs_(std::move(legs)) {}

  /// @param dt_s since the cycle before; 0 at first.
  void update(const TrunkInput& input, double dt_s);
  /// Back to the origin: another session began.
  void reset();

  const Eigen::Vector3d& position_m() const noexcept { return position_m_; }  ///< world
  const Eigen::Quaterniond& attitude() const noexcept { return attitude_; }
  TrunkSource source() const noexcept { return source_; }

 private:
  void estimate(const TrunkInput& input, double dt_s);
  void go_on(const TrunkInput& input, double dt_s);
  void take_odometry(const TrunkInput& input);
  double height_on_feet_m(const TrunkInput& input) const;

  std::vector<LegConfig> legs_;
  Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
  TrunkSource source_ = TrunkSource::kLegs;
  std::optional<Eigen::Vector3d> odometry_m_;                          ///< as it was last taken
  Eigen::Vector3d began_m_ = Eigen::Vector3d::Zero();                  ///< odometry's origin, as it is drawn
  Eigen::Quaterniond into_odometry_ = Eigen::Quaterniond::Identity();  ///< from the estimate's world
};

}  // namespace sprung::station
