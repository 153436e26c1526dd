#pragma once
/// The robot's parameters (robots/parameters.h) as they are now, and as an operator wants them. Pure; times
/// are the message's. No heap after construction.
///
/// A new value is reached in kRamp_s, so that no gain is a step of torque; a height by the motion that it
/// asks for.
#include <optional>
#include <vector>

#include "robots/parameters.h"
#include "signals/modes.h"

namespace sprung {

inline constexpr const char* kNoSuchParameter = "no such parameter of this robot under this preset";

class ParameterSettings {
 public:
  /// [design choice] a spring at twice its stiffness then pushes a robot at rest up within a second.
  static constexpr double kRamp_s = 1.0;

  ParameterSettings(const RobotConfig& robot, const PresetConfig& preset);

  const AdjustableConfig& acting() const noexcept { return acting_; }

  /// Why it cannot be set so now, static text; nullptr: it can.
  const char* why_not(std::int64_t id, double value, MotionPhase state) const noexcept;
  /// From now on it goes there. The caller has asked why_not().
  void set(std::int64_t id, double value, std::int64_t now_us) noexcept;
  /// To be called once a cycle. @return whether a value that acts is another one than before.
  bool advance(std::int64_t now_us) noexcept;

  struct Wanted {
    std::int64_t id = 0;
    double value = 0.0;
  };
  /// The first behind that one (0: of all) that is wanted at another value than robot.yaml's; id 0: none. Of
  /// an id that is none of them, nothing.
  std::optional<Wanted> next_changed(std::int64_t behind) const noexcept;

 private:
  struct Ramp {
    double from = 0.0;
    double to = 0.0;
    std::int64_t began_us = 0;
    bool runs = false;
  };
  AdjustableConfig acting_;
  std::vector<Parameter> parameters_;
  std::vector<Ramp> ramps_;  ///< one for each
};

}  // namespace sprung
