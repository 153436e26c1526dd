#pragma once
/// Steps of a robot in a gait: how well feet follow in swing, how hard they touch down. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/simulation.h"
#include "signals/vec3.h"

namespace sprung {

struct Touchdown {
  std::size_t leg = 0;
  double time_s = 0.0;
  double ground_error_m = 0.0;  ///< of the true floor there, over the one that was expected
  double force_N = 0.0;         ///< true contact force, its peak within StepScore::kImpact_s
  double knee_Nm = 0.0;         ///< true gear output of the leg's last joint, the same
};

/// What one cycle shows of it.
struct StepSigns {
  const JointState& joints;
  const LegCommand& command;
  const MotionState& motion;
  const SimTruth& truth;
};

class StepScore {
 public:
  static constexpr double kImpact_s = 0.15;

  /// @param floor_m where the robot expects it, world.
  explicit StepScore(const RobotConfig& robot, double floor_m = 0.0);
  void add(const StepSigns& now);

  /// Of the distance between wanted and measured foot, over all cycles of swing and pre-stance before
  /// contact; NaN without.
  double swing_rms_m() const noexcept;
  /// Impacts that are over.
  const std::vector<Touchdown>& touchdowns() const noexcept { return touchdowns_; }

 private:
  struct Leg {
    std::size_t knee = 0;
    bool in_air = false;
    int cycles_left = 0;  ///< of the impact; 0: none
    Touchdown impact;
  };
  void add_leg(std::size_t i, const StepSigns& now);
  void touch_down(std::size_t i, const StepSigns& now);

  const double cycle_s_;
  const double floor_m_;
  std::vector<Leg> legs_;
  double squares_m2_ = 0.0;
  double swing_cycles_ = 0.0;
  std::vector<Touchdown> touchdowns_;
};

struct TouchdownPeaks {
  double worst_N = kNaN, mean_N = kNaN;
  double worst_Nm = kNaN, mean_Nm = kNaN;
};
/// NaN of none.
TouchdownPeaks touchdown_peaks(const std::vector<Touchdown>& touchdowns) noexcept;

/// How far it came, and whither it turned. World axes.
class TravelScore {
 public:
  void add(const SimTruth& truth, double dt_s);
  double distance_m() const noexcept;                     ///< as the crow flies
  double speed_m_s() const noexcept;                      ///< that over time; NaN at first
  double drift_rad() const noexcept { return yaw_rad_; }  ///< turned since the first cycle, left positive

 private:
  bool began_ = false;
  double time_s_ = 0.0;
  Vec3 from_m_{}, at_m_{};
  double last_yaw_rad_ = 0.0, yaw_rad_ = 0.0;
};

}  // namespace sprung
