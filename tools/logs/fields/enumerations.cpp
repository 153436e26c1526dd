#include "tools/logs/fields/enumerations.h"

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
      named<DriveMode>("DriveMode"),
      named<PowerState>("PowerState"),
      named<SafetyLevel>("SafetyLevel"),
      named<SafetyCause>("SafetyCause"),
      named<JointStatus>("JointStatus"),
      named<ControlMode>("ControlMode"),
      named<LegPhase>("LegPhase"),
      named<MotionPhase>("MotionPhase"),
      named<LegEvent>("LegEvent"),
      named<GaitControl>("GaitControl"),
      named<JumpMode>("JumpMode"),
      named<OperatorKind>("OperatorKind"),
      named<OperatorOutcome>("OperatorOutcome"),
      named<ProcessState>("ProcessState"),
      named<ImuStatus>("ImuStatus"),
      named<SimControlKind>("SimControlKind"),
      named<FaultKind>("FaultKind"),
      named<BusCondition>("BusCondition"),
      named<ReferenceSource>("ReferenceSource"),
      named<LogEndReason>("LogEndReason"),
  };
  return all;
}

const Enumeration* find_enumeration(std::string_view name) noexcept {
  for (const Enumeration& one : enumerations()) {
    if (name == one.name) return &one;
  }
  return nullptr;
}

}  // namespace sprung::fields
