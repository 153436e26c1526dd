#pragma once
/// sprung's own landing (JumpMode::kAdaptive) of one leg: from lift-off, or from the beginning of a fall, to
/// the end of the landing. docs/control.md, "Landing", derives it. Pure; time is the message's.
///
/// In a fall the foot meets the ground nearly at rest instead of the ground stopping the rotors
/// (foot_fall.h), braked no harder than the motors can (braking_limit.h). From measured contact on the leg
/// yields so that the body stops evenly over the way that is left. First the motors move the rotors as the
/// measured force would move a light foot, and take its horizontal part off; then a soft spring and damper
/// are left, and the planned force is fed forward.
#include <cstdint>

#include "planner/ballistics.h"
#include "planner/braking_limit.h"
#include "planner/foot_fall.h"
#include "planner/foot_move.h"
#include "planner/leg_gains.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/vec3.h"

namespace sprung {

struct AdaptiveLandingInput {
  std::int64_t utime_us = 0;
  FootPoint planned;  ///< where jump or fall would have the foot now
  JumpProgress progress;
  EstimatedLeg measured;  ///< foot, its velocity and force, contact
};

struct AdaptiveLandingOutput {
  FootPoint desired;
  ControlMode control_mode = ControlMode::kPosition;
  StiffnessConfig gains;  ///< in compliance
  Vec3 feedforward_force_N{0, 0, 0};
  double friction_compensation = 0.0;
  double inertia_compensation = 0.0;
};

class AdaptiveLanding {
 public:
  AdaptiveLanding(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset);

  /// Flight begins.
  void begin(const ExpectedTouchdown& expected) noexcept;
  /// Once a cycle, in flight and landing. @param in.progress.phase says which; kLanding from the cycle of the
  /// measured touchdown.
  AdaptiveLandingOutput step(const AdaptiveLandingInput& in) noexcept;
  /// The preset's gains are others now; the landing's own law stays.
  void adjust(const PresetConfig& preset) noexcept { preset_ = preset; }

 private:
  enum class Stage { kBefore, kAir, kGround };

  AdaptiveLandingOutput as_hybrid(const AdaptiveLandingInput& in) const noexcept;
  void start(const AdaptiveLandingInput& in) noexcept;
  /// How the foot is pushed; what is felt in the air, where nothing pushes, is the model's error.
  void feel(double dt_s) noexcept;
  bool touched(const AdaptiveLandingInput& in) const noexcept;
  void touch_down(const AdaptiveLandingInput& in) noexcept;
  void yield(double dt_s) noexcept;
  AdaptiveLandingOutput output() const noexcept;
  void air(AdaptiveLandingOutput& out) const noexcept;
  void ground(AdaptiveLandingOutput& out) const noexcept;
  /// By `share`, spring, damper and `force_N` along this axis move a mass instead of the rotors as they are.
  void move_as_mass(std::size_t axis, double mass_kg, double force_N, double share,
                    AdaptiveLandingOutput& out) const noexcept;
  double force_rise() const noexcept;

  PresetConfig preset_;
  AdaptiveLandingConfig config_;
  BrakingLimit motors_;
  FootFall fall_;
  ExpectedTouchdown expected_;
  Stage stage_ = Stage::kBefore;
  std::int64_t now_us_ = 0;
  FootPoint foot_;  ///< desired
  EstimatedLeg measured_;
  double stopping_m_s2_ = 0.0;  ///< of the body, in kGround
  double ground_s_ = 0.0;       ///< since contact
  double pushed_s_ = 0.0;       ///< for how long the foot's force has been beyond its bound
  double pushed_hard_s_ = 0.0;  ///< likewise, far beyond it
  double risen_s_ = 0.0;        ///< for how long it has been well above what it was just before
  Vec3 air_force_N_{0, 0, 0};   ///< what it was just before
};

}  // namespace sprung
