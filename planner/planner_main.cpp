/// sprung-motion-planner: JOINT_STATE(k) and operator commands in, LEG_COMMAND(k) and MOTION_STATE(k) out.
#include <optional>

#include "lcmtypes/channels.h"
#include "planner/planner_core.h"
#include "runtime/answer_store.h"
#include "runtime/process.h"
#include "runtime/responder_loop.h"

namespace sprung {
namespace {

/// Emergency stop, clear and homing are the bridge's.
bool is_motion(OperatorKind kind) {
  return kind != OperatorKind::kEstop && kind != OperatorKind::kClear && kind != OperatorKind::kHome;
}

class PlannerShell final : public ResponderShell {
 public:
  explicit PlannerShell(Process& process)
      : process_(process),
        joint_states_(in_),
        leg_answers_(legs_out_),
        motion_answers_(motion_out_),
        leg_commands_(process.node().publisher<LegCommand>(channels::kLegCommand)),
        motion_states_(process.node().publisher<MotionState>(channels::kMotionState)),
        replies_(process.node().publisher<OperatorReply>(channels::kOperatorReply)) {
    restart();
    const auto counts = CountLimits::exactly(robot_.joints.size(), robot_.legs.size());
    process.node().subscribe(channels::kJointState, counts, joint_states_);
    process.node().subscribe(channels::kOperatorCommand, CountLimits::none(), commands_);
  }

  ResponderView look() override { return {joint_states_.held(), {}, joint_states_.take_repeated(), 0}; }

  void between_cycles() override {
    while (const auto command = commands_.pop()) {
      if (!is_motion(command->kind)) continue;
      if (!core_->submit(*command)) {
        reply(*command, OperatorOutcome::kRefused, "too many commands wait");
      } else if (command->apply_at_seq > process_.status().stamp.seq + 1) {
        reply(*command, OperatorOutcome::kQueued, "waits for its cycle");
      }
    }
  }

  std::optional<Stamp> step(std::int64_t seq) override {
    if (!joint_states_.get(seq, in_)) return std::nullopt;
    core_->step(in_, legs_out_, motion_out_);
    leg_answers_.keep(legs_out_);
    motion_answers_.keep(motion_out_);
    leg_commands_.publish(legs_out_);
    motion_states_.publish(motion_out_);
    for (OperatorReply reply; core_->next_reply(reply);) replies_.publish(reply);
    return in_.stamp;
  }

  void resend(std::int64_t seq) override {
    for (const std::int64_t stored : {seq - 1, seq}) {
      if (const LegCommand* answer = leg_answers_.find(stored)) leg_commands_.publish(*answer);
      if (const MotionState* answer = motion_answers_.find(stored)) motion_states_.publish(*answer);
    }
  }

  void restart() override {
    core_.emplace(robot_, process_.preset());
    leg_answers_.clear();
    motion_answers_.clear();
  }

 private:
  void reply(const OperatorCommand& command, OperatorOutcome outcome, const char* reason) {
    OperatorReply answer;
    answer.stamp = {process_.node().utime_us(), process_.status().stamp.seq};
    answer.request_id = command.request_id;
    answer.outcome = outcome;
    answer.answered_by = "planner";
    answer.reason = reason;
    replies_.publish(answer);
  }

  Process& process_;
  const RobotConfig& robot_ = process_.robot();
  JointState in_{robot_.joints.size(), robot_.legs.size()};
  LegCommand legs_out_{robot_.legs.size()};
  MotionState motion_out_{robot_.legs.size()};
  Slot<JointState> joint_states_;
  InputQueue<OperatorCommand> commands_;
  AnswerStore<LegCommand> leg_answers_;
  AnswerStore<MotionState> motion_answers_;
  Publisher<LegCommand> leg_commands_;
  Publisher<MotionState> motion_states_;
  Publisher<OperatorReply> replies_;
  std::optional<PlannerCore> core_;
};

int plan(Process& process) {
  PlannerShell shell(process);
  const auto responder = make_responder(process, {});
  return run_responder(process, *responder, shell);
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  return sprung::run_process(
      argc, argv, {"sprung-motion-planner", "Stand, jump and sit: desired foot motion for each leg."},
      sprung::plan);
}
