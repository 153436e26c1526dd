#include "planner/parameter_settings.h"

#include <algorithm>
#include <cmath>

namespace sprung {

ParameterSettings::ParameterSettings(const RobotConfig& robot, const PresetConfig& preset)
    : acting_(adjustable_of(robot, preset)), parameters_(parameters_of(robot, preset)) {
  for (const Parameter& one : parameters_) ramps_.push_back({one.at(acting_), one.at(acting_), 0, false});
}

bool ParameterSettings::is_one(int parameter) const noexcept {
  return parameter >= 0 && parameter < static_cast<int>(parameters_.size());
}

const char* ParameterSettings::why_not(int parameter, double value, MotionPhase state) const noexcept {
  if (!is_one(parameter)) return "no such parameter of this robot under this preset";
  const Parameter& one = parameters_[static_cast<std::size_t>(parameter)];
  if (!std::isfinite(value)) return "the value is no number";
  if (!one.allows(value))
    return one.tightens_only ? "beyond its range: a limit may only be tightened" : "beyond its range";
  const bool rests = state == MotionPhase::kIdle || state == MotionPhase::kStanding ||
                     state == MotionPhase::kWalking;
  return one.moves_body && !rests ? "only while the robot stands, walks or is off" : nullptr;
}

void ParameterSettings::set(int parameter, double value, std::int64_t now_us) noexcept {
  Ramp& ramp = ramps_[static_cast<std::size_t>(parameter)];
  ramp = {parameters_[static_cast<std::size_t>(parameter)].at(acting_), value, now_us, true};
}

bool ParameterSettings::advance(std::int64_t now_us) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < ramps_.size(); ++i) {
    Ramp& ramp = ramps_[i];
    if (!ramp.runs) continue;
    const double share = 1e-6 * static_cast<double>(now_us - ramp.began_us) / kRamp_s;
    // Of a bridge that was restarted, the old time means nothing.
    ramp.runs = !parameters_[i].moves_body && share >= 0.0 && share < 1.0;
    parameters_[i].at(acting_) = ramp.runs ? ramp.from + share * (ramp.to - ramp.from) : ramp.to;
    moved = true;
  }
  return moved;
}

int ParameterSettings::next_changed(int from) const noexcept {
  for (int i = std::max(0, from); i < static_cast<int>(parameters_.size()); ++i)
    if (wanted(i) != parameters_[static_cast<std::size_t>(i)].file) return i;
  return -1;
}

}  // namespace sprung
