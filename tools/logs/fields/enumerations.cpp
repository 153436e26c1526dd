#include "tools/logs/fields/enumerations.h"

#include "signals/modes.h"

namespace sprung::fields {

namespace {

const char* imu_status_name(std::int8_t value) noexcept {
  switch (static_cast<ImuStatus>(value)) {
    case ImuStatus::kStarting:
      return "starting";
    case ImuStatus::kGood:
      return "good";
    case ImuStatus::kNoAttitude:
      return "no attitude";
    case ImuStatus::kFault:
      return "fault";
  }
  return "unknown";
}

const char* sim_control_kind_name(std::int8_t value) noexcept {
  switch (static_cast<SimControlKind>(value)) {
    case SimControlKind::kWrench:
      return "wrench";
    case SimControlKind::kReset:
      return "reset";
    case SimControlKind::kSuspend:
      return "suspend";
    case SimControlKind::kDriveFault:
      return "drive fault";
    case SimControlKind::kDriveSilent:
      return "drive silent";
    case SimControlKind::kNodeFault:
      return "node fault";
    case SimControlKind::kFloor:
      return "floor";
    case SimControlKind::kImu:
      return "imu";
  }
  return "unknown";
}

/// The recorder's own (tools/logs/recorder/log_messages.h), not a signal's.
const char* log_end_reason_name(std::int8_t value) noexcept {
  switch (value) {
    case 0:
      return "asked for";
    case 1:
      return "goes on in the next part";
    case 2:
      return "the disk was nearly full";
    case 3:
      return "the disk took no more";
    default:
      return "unknown";
  }
}

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
      named<JumpMode>("JumpMode"),
      named<LegEvent>("LegEvent"),
      named<GaitControl>("GaitControl"),
      named<OperatorKind>("OperatorKind"),
      named<OperatorOutcome>("OperatorOutcome"),
      named<ProcessState>("ProcessState"),
      named<FaultKind>("FaultKind"),
      named<BusCondition>("BusCondition"),
      named<ReferenceSource>("ReferenceSource"),
      {"ImuStatus", imu_status_name},
      {"SimControlKind", sim_control_kind_name},
      {"LogEndReason", log_end_reason_name},
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
