#pragma once
/// The robot's parameters (robots/parameters.h) as they are now, and as an operator wants them. Pure; times
/// are the message's. No heap after construction.
///
/// A new value is reached in kRamp_s, so that no gain is a step of torque; a height by the motion that it
/// asks for.
#include <vector>

#include "robots/parameters.h"
#include "signals/modes.h"

namespace sprung {

class ParameterSettings {
 public:
  /// [design choice] a spring at twice its stiffness then pushes a robot at rest up within a second.
  static constexpr double kRamp_s = 1.0;

  ParameterSettings(const RobotConfig& robot, const PresetConfig& preset);

  const AdjustableConfig& acting() const noexcept { return acting_; }

  /// Why it cannot be set so now, static text; nullptr: it can.
  const char* why_not(int parameter, double value, MotionPhase state) const noexcept;
  /// From now on it goes there. The caller has asked why_not().
  void set(int parameter, double value, std::int64_t now_us) noexcept;
  /// To be called once a cycle. @return whether a value that acts is another one than before.
  bool advance(std::int64_t now_us) noexcept;

  /// First from here on that is wanted at another value than robot.yaml's; -1: none.
  int next_changed(int from) const noexcept;
  double wanted(int parameter) const noexcept { return ramps_[static_cast<std::size_t>(parameter)].to; }

 private:
  struct Ramp {
    double from = 0.0;
    double to = 0.0;
    std::int64_t began_us = 0;
    bool runs = false;
  };
  bool is_one(int parameter) const noexcept;

  AdjustableConfig acting_;
  std::vector<Parameter> parameters_;
  std::vector<Ramp> ramps_;  ///< one for each
};

}  // namespace sprung
