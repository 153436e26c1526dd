#include "planner/parameter_settings.h"

#include <cmath>

namespace sprung {

ParameterSettings::ParameterSettings(const RobotConfig& robot, const PresetConfig& preset)
    : acting_(adjustable_of(robot, preset)), parameters_(parameters_of(robot, preset)) {
  for (const Parameter& one : parameters_) ramps_.push_back({one.at(acting_), one.at(acting_), 0, false});
}

const char* ParameterSettings::why_not(std::int64_t id, double value, MotionPhase state) const noexcept {
  const auto place = place_of(parameters_, id);
  if (!place) return kNoSuchParameter;
  const Parameter& one = parameters_[*place];
  if (!std::isfinite(value)) return "the value is no number";
  if (!one.allows(value))
    return one.tightens_only ? "beyond its range: a limit may only be tightened" : "beyond its range";
  const bool rests = state == MotionPhase::kIdle || state == MotionPhase::kStanding ||
                     state == MotionPhase::kWalking;
  return one.moves_body && !rests ? "only while the robot stands, walks or is off" : nullptr;
}

void ParameterSettings::set(std::int64_t id, double value, std::int64_t now_us) noexcept {
  const auto place = place_of(parameters_, id);
  if (place) ramps_[*place] = {parameters_[*place].at(acting_), value, now_us, true};
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

std::optional<ParameterSettings::Wanted> ParameterSettings::next_changed(std::int64_t behind) const noexcept {
  const auto place = place_of(parameters_, behind);
  if (behind != 0 && !place) return std::nullopt;
  for (std::size_t i = place ? *place + 1 : 0; i < parameters_.size(); ++i)
    if (ramps_[i].to != parameters_[i].file) return Wanted{parameters_[i].id, ramps_[i].to};
  return Wanted{};
}

}  // namespace sprung
