#pragma once
/// Operator commands that take the bridge a while (clear, home): sent, followed to their end, and the robot's
/// health afterwards.
#include <functional>
#include <optional>

#include "signals/operator.h"
#include "tools/operate/client/health_report.h"
#include "tools/operate/client/operator_client.h"

namespace sprung {

/// Called while the bridge recovers, when another node is or is not operational; may be empty.
using HealthProgress = std::function<void(const sprung_msgs::bus_state_t&)>;

/// @return the last answer (done, failed or refused), nullopt when there was none. `health` then holds a
/// BUS_STATE and a SAFETY_STATE from after it, where the bridge sends them.
std::optional<OperatorAnswer> run_long_command(const RunInfo& info, OperatorCommand& command,
                                               HealthListener& health, const HealthProgress& progress);

}  // namespace sprung
