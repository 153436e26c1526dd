#pragma once
/// Whether a robot was safe while something went wrong, by the simulation's truth and the raw frames on its
/// buses. The stack's own word counts only where a rule asks what it had said by then. Pure.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/profiles/drive_profile.h"
#include "robots/robot_config.h"
#include "signals/safety_state.h"
#include "signals/simulation.h"

namespace sprung::campaign {

/// Rules of a run, each broken at most once a run.
enum class Rule : std::uint8_t {
  kUncommandedEnable,  ///< a drive gets power though nobody cleared or commanded since it lost it
  kDrivingStop,        ///< damping, 10 ms after it began, puts more than 1 J into a joint
  kTorqueStays,        ///< a latched stop, or a bridge that has fallen silent, and motors have torque when
                       ///< they must not any more
  kBeyondLimit,        ///< a joint 50 mrad beyond its limits, pushed there, without a cause within 50 ms
  kTooFast,            ///< above 1.2 times the speed limit for 20 ms, without a cause within 50 ms
  kBadSetpoint,  ///< on the bus: beyond the torque limit, or 0.15 rad and more beyond the joint's limits
  kDisagrees,    ///< SAFETY_STATE says disabled, and motors have torque
};
constexpr auto words_of(Rule) {
  using E = Rule;
  return words<E>({{E::kUncommandedEnable, "uncommanded_enable"},
                   {E::kDrivingStop, "driving_stop"},
                   {E::kTorqueStays, "torque_stays"},
                   {E::kBeyondLimit, "beyond_limit"},
                   {E::kTooFast, "too_fast"},
                   {E::kBadSetpoint, "bad_setpoint"},
                   {E::kDisagrees, "disagrees"}});
}

struct Breach {
  Rule rule;
  std::int64_t seq = -1;
  std::string detail;  ///< joint or drive, and number
};

/// What the judge is shown after each cycle.
struct Scene {
  std::int64_t seq = -1;
  const SimTruth* truth = nullptr;
  /// Of each actuator's motor, at the gear's output. Zero: its drive gives no current.
  const std::vector<double>* motor_torque_Nm = nullptr;
  const SafetyState* said = nullptr;
};

class Judge {
 public:
  /// @param machine what the robot truly is, not what a wrong file says of it; each joint has the actuator of
  /// its number. @throws std::invalid_argument where there are not as many of each.
  explicit Judge(const RobotConfig& machine);

  /// Frames of the bridge on their way to the drives, and those of the drives.
  void sent(const FrameBatch& frames) noexcept;
  void answered(const FrameBatch& frames) noexcept;
  void look(const Scene& scene);
  /// An operator has asked for power: `stand`, `clear` and the like. Until the drives have it they may take
  /// it.
  void operator_asked() noexcept;

  const std::vector<Breach>& breaches() const noexcept { return breaches_; }
  double fastest_share() const noexcept { return fastest_share_; }       ///< of a joint's speed limit
  double farthest_beyond_rad() const noexcept { return farthest_rad_; }  ///< its limits
  double damping_work_J() const noexcept;                                ///< put into the worst joint
  bool any_enabled() const noexcept;

 private:
  struct Drive;
  struct Joint {
    int beyond = 0, fast = 0;  ///< cycles
    double work_J = 0.0;
  };
  void breach(Rule rule, const std::string& detail);
  void look_at_setpoint(Drive& drive, const CanFrame& frame);
  void look_at_joint(std::size_t j, const Scene& scene);
  void look_at_stop(const Scene& scene);
  int cycles(double seconds) const noexcept;

  RobotConfig robot_;
  std::vector<std::shared_ptr<Drive>> drives_;
  std::vector<Joint> joints_;
  std::vector<Breach> breaches_;
  std::int64_t seq_ = -1;
  bool operator_asked_ = true;
  int damped_ = 0;  ///< cycles since the stack said so
  bool bridge_spoke_ = false;
  int silent_ = 0;    ///< cycles since the bridge sent anything
  int stopped_ = 0;   ///< cycles since a latched stop was said
  int disabled_ = 0;  ///< cycles
  double fastest_share_ = 0.0, farthest_rad_ = 0.0;
};

}  // namespace sprung::campaign
