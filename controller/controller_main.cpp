/// sprung-leg-controller: JOINT_STATE(k) and LEG_COMMAND(k-1) in, DRIVE_COMMAND(k) out.
#include <optional>

#include "controller/command_report.h"
#include "controller/controller_core.h"
#include "lcmtypes/channels.h"
#include "runtime/answer_store.h"
#include "runtime/log.h"
#include "runtime/process.h"
#include "runtime/responder_loop.h"

namespace sprung {
namespace {

/// A basis that changes to and fro in every cycle must not fill the log.
constexpr std::int64_t kLogInterval_us = 100'000;

class ControllerShell final : public ResponderShell {
 public:
  explicit ControllerShell(Process& process)
      : process_(process),
        joint_states_(in_),
        leg_commands_(command_),
        answers_(out_),
        drive_commands_(process.node().publisher<DriveCommand>(channels::kDriveCommand)) {
    restart();
    const std::size_t legs = robot_.legs.size();
    process.node().subscribe(channels::kJointState, CountLimits::exactly(robot_.joints.size(), legs),
                             joint_states_);
    process.node().subscribe(channels::kLegCommand, CountLimits::exactly(legs), leg_commands_);
  }

  ResponderView look() override {
    return {joint_states_.held(), leg_commands_.held(), joint_states_.take_repeated(), 0};
  }

  std::optional<Stamp> step(std::int64_t seq) override {
    if (!joint_states_.get(seq, in_)) return std::nullopt;
    const bool commanded = leg_commands_.newest_at_or_before(seq - 1, command_);
    core_->step(in_, commanded ? &command_ : nullptr, out_);
    answers_.keep(out_);
    drive_commands_.publish(out_);
    report();
    return in_.stamp;
  }

  void resend(std::int64_t seq) override {
    for (const std::int64_t stored : {seq - 1, seq}) {
      if (const DriveCommand* answer = answers_.find(stored)) drive_commands_.publish(*answer);
    }
  }

  void restart() override {
    core_.emplace(robot_, process_.preset(), process_.watchdogs());
    answers_.clear();
  }

 private:
  /// After the command has left: this may make texts.
  void report() {
    const std::int64_t now_us = process_.node().utime_us();
    const auto news = report_.update(core_->basis(), core_->limits(), now_us);
    if (news == CommandReport::News::kNone) return;
    process_.status().detail = report_.text();
    if (news != CommandReport::News::kBasis || !log_limit_.allow(now_us)) return;
    // What safety does is the bridge's to say, with its cause.
    const bool own_doubt = core_->basis() != CommandBasis::kCommanded &&
                           core_->basis() != CommandBasis::kSafety;
    own_doubt ? log_warn("damping or off: " + report_.text()) : log_debug(report_.text());
  }

  Process& process_;
  const RobotConfig& robot_ = process_.robot();
  JointState in_{robot_.joints.size(), robot_.legs.size()};
  LegCommand command_{robot_.legs.size()};
  DriveCommand out_{robot_.actuators.size()};
  Slot<JointState> joint_states_;
  Slot<LegCommand> leg_commands_;
  AnswerStore<DriveCommand> answers_;
  Publisher<DriveCommand> drive_commands_;
  std::optional<ControllerCore> core_;
  CommandReport report_;
  LogLimit log_limit_{kLogInterval_us};
};

int control(Process& process) {
  ControllerShell shell(process);
  ResponderRole role;
  role.has_partner = true;
  const auto responder = make_responder(process, role);
  return run_responder(process, *responder, shell);
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  return sprung::run_process(
      argc, argv,
      {"sprung-leg-controller", "Drive set-points from desired foot motion: the virtual springs."},
      sprung::control);
}
