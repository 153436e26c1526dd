/// What operators ask of the bridge: clear and home, which take many cycles and are answered twice.
#include <algorithm>

#include "drivers/bridge/bridge_impl.h"

namespace sprung {

OperatorReply BridgeCore::Impl::clear(const OperatorCommand& command, std::int64_t time_us) noexcept {
  if (command.request_id == last_clear.reply.request_id) return last_clear.reply;
  if (command.request_id < last_clear.reply.request_id)
    return reply(command, "another clear was asked since");
  if (recovery->kind() == Recovery::Kind::kClear || recovery->kind() == Recovery::Kind::kBoot)
    return reply(command, "a clear is already under way");
  const char* refusal = why_not_clear(time_us);
  last_clear.reply = reply(command, refusal);
  if (refusal != nullptr) return last_clear.reply;
  if (!safety.latched()) {
    clear_without_work = true;
  } else {
    if (cyclic) doubt_lost_buses();
    recovery->begin(cyclic ? Recovery::Kind::kClear : Recovery::Kind::kBoot, time_us);
  }
  return last_clear.reply;
}

void BridgeCore::Impl::doubt_lost_buses() noexcept {
  for (BusNode* node : nodes) {
    if (const char* loss = buses.loss(node->link().setup().bus)) node->link().doubt(loss);
  }
  buses.forget_losses();
}

/// While a clear is under way: since it began, for it has forgotten what was before.
bool BridgeCore::Impl::any_bus_loss() const noexcept {
  for (std::size_t bus = 0; bus < robot.buses.size(); ++bus) {
    if (buses.loss(static_cast<int>(bus)) != nullptr) return true;
  }
  return false;
}

/// What only somebody else can mend; nullptr when the bridge can try.
const char* BridgeCore::Impl::why_not_clear(std::int64_t time_us) const noexcept {
  if (shutting_down) return "the bridge is shutting down";
  if (!safety.latched() || !cyclic) return nullptr;
  if (buses.any_lost()) return buses.what_to_mend();
  if (stopping_input() != nullptr)
    return "the emergency stop at a drive's input is still pressed: release it";
  if (safety.level() == SafetyLevel::kLowering) return "the robot is being let down: wait until it is off";
  const bool by_command = safety.cause() == SafetyCause::kCommandStale ||
                          safety.cause() == SafetyCause::kCommandRefused;
  if (by_command && command_age_s(time_us, false) > watchdogs.command_hold_s)
    return "no good DRIVE_COMMAND is coming in";
  return nullptr;
}

OperatorReply BridgeCore::Impl::home(const OperatorCommand& command, std::int64_t time_us) noexcept {
  if (command.request_id == last_home.reply.request_id) return last_home.reply;
  if (command.request_id < last_home.reply.request_id) return reply(command, "another home was asked since");
  if (homing->running()) return reply(command, "homing is already under way");
  const char* refusal = why_not_home();
  if (refusal == nullptr) refusal = homing->begin(command, time_us);
  last_home.reply = reply(command, refusal);
  return last_home.reply;
}

const char* BridgeCore::Impl::why_not_home() const noexcept {
  if (shutting_down) return "the bridge is shutting down";
  if (!cyclic) return "drives are still being configured";
  if (recovery->running()) return "a clear is under way";
  const bool off = all_drives([](const DriveNode& drive) { return !drive.powered(); });
  if (!off) return "a drive has power: sprung sit or estop first";
  return enabling() ? "drives are being enabled: sprung sit or estop first" : nullptr;
}

/// A drive on its way to power does not show power yet.
bool BridgeCore::Impl::enabling() const noexcept {
  if (safety.level() != SafetyLevel::kOperational) return false;
  const auto& commands = gate.last().actuators;
  return std::any_of(commands.begin(), commands.end(),
                     [](const ActuatorCommand& command) { return command.mode != DriveMode::kDisabled; });
}

void BridgeCore::Impl::step_requests(std::int64_t time_us) noexcept {
  const Recovery::Kind kind = recovery->kind();
  if (kind == Recovery::Kind::kClear && any_bus_loss())
    recovery->abort("a bus was lost while the clear was under way");
  const Recovery::Result recovered = recovery->step(time_us);
  if (kind != Recovery::Kind::kFirstCycle) finish_clear(recovered, time_us);
  if (clear_without_work) {
    clear_without_work = false;
    safety.forget_past();
    for (BusNode* node : nodes) node->link().set_recovery_text(node->condition().note, "nothing to do");
    answer(last_clear, OperatorOutcome::kDone, "nothing was latched");
  }
  const Homing::Result homed = homing->step(time_us, why_not_home());
  if (homed == Homing::Result::kDone) {
    ++homings;
    answer(last_home, OperatorOutcome::kDone, "referenced");
  } else if (homed == Homing::Result::kFailed) {
    answer(last_home, OperatorOutcome::kFailed, homing->reason());
  }
}

void BridgeCore::Impl::finish_clear(Recovery::Result result, std::int64_t time_us) noexcept {
  if (result == Recovery::Result::kNothing) return;
  if (result == Recovery::Result::kFailed) {
    answer(last_clear, OperatorOutcome::kFailed, recovery->reason());
    return;
  }
  gate.disarm();
  masters.forget();
  for (auto& drive : drives) drive->forget_stop();
  safety.clear(time_us, cycle);
  answer(last_clear, OperatorOutcome::kDone, "cleared");
}

void BridgeCore::Impl::answer(LongRequest& request, OperatorOutcome outcome, const char* reason) noexcept {
  request.reply.stamp = {now_us, cycle};
  request.reply.outcome = outcome;
  request.reply.reason = reason;
  request.reply.took_effect_at_seq = outcome == OperatorOutcome::kDone ? cycle : -1;
  request.answer_due = true;
}

OperatorReply BridgeCore::Impl::reply(const OperatorCommand& command, const char* refusal) const noexcept {
  OperatorReply answer;
  answer.stamp = {now_us, cycle};
  answer.request_id = command.request_id;
  answer.answered_by = "bridge";
  answer.outcome = refusal == nullptr ? OperatorOutcome::kAccepted : OperatorOutcome::kRefused;
  answer.reason = refusal == nullptr ? "" : refusal;
  answer.took_effect_at_seq = refusal == nullptr ? cycle : -1;
  return answer;
}

}  // namespace sprung
