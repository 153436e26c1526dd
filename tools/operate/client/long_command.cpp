#include "tools/operate/client/long_command.h"

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"

namespace sprung {
namespace {

constexpr double kAcceptance_s = 3.0;
constexpr double kTurn_s = 0.1;
/// Some 5 s of message time; a loaded lock-step run may take longer by the wall.
constexpr double kTimeout_s = 30.0;
constexpr double kAfter_s = 0.5;  // BUS_STATE and SAFETY_STATE come ten times a second

bool is_over(const std::optional<OperatorAnswer>& answer) {
  return !answer ||
         (answer->outcome != OperatorOutcome::kAccepted && answer->outcome != OperatorOutcome::kQueued);
}

/// One letter a node.
std::string who_is_up(const sprung_msgs::bus_state_t& state) {
  std::string text;
  for (const sprung_msgs::node_health_t& node : state.nodes) text += node.operational ? 'y' : 'n';
  return text;
}

}  // namespace

std::optional<OperatorAnswer> run_long_command(const RunInfo& info, OperatorCommand& command,
                                               HealthListener& health, const HealthProgress& progress) {
  OperatorClient client(info);
  std::optional<OperatorAnswer> answer = client.send(command, kAcceptance_s);
  const std::int64_t end_us = monotonic_us() + static_cast<std::int64_t>(1e6 * kTimeout_s);
  std::string told;
  while (!stop_requested() && monotonic_us() < end_us && !is_over(answer)) {
    if (const auto last = client.wait_done(command, kTurn_s)) answer = last;
    health.wait(0.0, [] { return true; });
    if (!progress || !health.bus() || !health.bus()->recovering) continue;
    const std::string up = who_is_up(*health.bus());
    if (up != told) progress(*health.bus());
    told = up;
  }
  if (!is_over(answer)) return std::nullopt;
  const std::int64_t done_seq = answer ? answer->took_effect_at_seq : -1;
  health.wait(kAfter_s, [&] {
    return health.bus() && health.safety() && health.bus()->seq > done_seq && health.safety()->seq > done_seq;
  });
  return answer;
}

}  // namespace sprung
