#include "tools/logs/fields/enumerations.h"

#include <algorithm>
#include <cstddef>

#include "signals/modes.h"

namespace sprung::fields {

namespace {

template <class E>
Enumeration named(const char* enumeration) {
  return {enumeration, [](std::int8_t value) noexcept { return sprung::name(static_cast<E>(value)); }};
}

}  // namespace

const std::vector<Enumeration>& enumerations() {
  static const std::vector<Enumeration> all{
      named<DriveMode>("drive_mode_t"),
      named<PowerState>("power_state_t"),
      named<SafetyLevel>("safety_level_t"),
      named<SafetyCause>("safety_cause_t"),
      named<JointStatus>("joint_status_t"),
      named<MisfitReason>("misfit_reason_t"),
      named<ControlMode>("control_mode_t"),
      named<LegPhase>("leg_phase_t"),
      named<MotionPhase>("motion_phase_t"),
      named<LegEvent>("leg_event_t"),
      named<GaitControl>("gait_control_t"),
      named<JumpMode>("jump_mode_t"),
      named<OperatorKind>("operator_kind_t"),
      named<OperatorOutcome>("operator_outcome_t"),
      named<ProcessState>("process_state_t"),
      named<ImuStatus>("imu_status_t"),
      named<SimControlKind>("sim_control_kind_t"),
      named<FaultKind>("fault_kind_t"),
      named<BusCondition>("bus_condition_t"),
      named<ReferenceSource>("reference_source_t"),
      named<LogEndReason>("log_end_reason_t"),
  };
  return all;
}

const Enumeration* find_enumeration(std::string_view name) noexcept {
  for (const Enumeration& one : enumerations()) {
    if (name == one.name) return &one;
  }
  return nullptr;
}

const Enumeration* enumeration_in(std::string_view comment) noexcept {
  constexpr std::string_view kOfWords = "abcdefghijklmnopqrstuvwxyz_";
  for (std::size_t begin = 0; (begin = comment.find_first_of(kOfWords, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(comment.find_first_not_of(kOfWords, begin), comment.size());
    if (const Enumeration* found = find_enumeration(comment.substr(begin, end - begin))) return found;
    begin = end;
  }
  return nullptr;
}

}  // namespace sprung::fields
