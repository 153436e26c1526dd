#pragma once
/// Every enumeration that crosses processes, for tests that ask something of each.
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "signals/modes.h"
#include "tests/support/enumerators.h"

namespace sprung::test {

using EveryEnumeration = std::tuple<DriveMode, PowerState, SafetyLevel, SafetyCause, JointStatus, ControlMode,
                                    LegPhase, MotionPhase, LegEvent, GaitControl, JumpMode, OperatorKind,
                                    OperatorOutcome, ProcessState, ImuStatus, SimControlKind, FaultKind,
                                    BusCondition, ReferenceSource, LogEndReason, MisfitReason>;

/// Calls @p ask with a value of each.
template <class Ask>
void of_every_enumeration(const Ask& ask) {
  std::apply([&ask](auto... values) { (ask(values), ...); }, EveryEnumeration{});
}

}  // namespace sprung::test
