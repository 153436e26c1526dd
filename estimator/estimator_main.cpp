/// sprung-torque-estimator: DRIVE_STATE(k), and IMU(k) of robots that have one, in; JOINT_STATE(k) out, and
/// of robots with a trunk BODY_STATE of every fifth cycle.
#include <optional>

#include "estimator/estimator_core.h"
#include "estimator/misfit_note.h"
#include "lcmtypes/channels.h"
#include "runtime/answer_store.h"
#include "runtime/process.h"
#include "runtime/responder_loop.h"

namespace sprung {
namespace {

class EstimatorShell final : public ResponderShell {
 public:
  explicit EstimatorShell(Process& process)
      : process_(process),
        robot_(process.robot()),
        watchdogs_(process.watchdogs()),
        drive_states_(in_),
        answers_(out_),
        joint_states_(process.node().publisher<JointState>(channels::kJointState)),
        body_states_(process.node().publisher<BodyState>(channels::kBodyState)) {
    restart();
    process.node().subscribe(channels::kDriveState, CountLimits::exactly(robot_.actuators.size()),
                             drive_states_);
    if (robot_.body.imu) process.node().subscribe(channels::kImu, CountLimits::none(), imus_);
  }

  ResponderView look() override {
    return {drive_states_.held(), imus_.held(), drive_states_.take_repeated(), 0};
  }

  std::optional<Stamp> step(std::int64_t seq) override {
    if (!drive_states_.get(seq, in_)) return std::nullopt;
    const bool measured = imus_.newest_at_or_before(seq, imu_);
    core_->step(in_, out_, measured ? &imu_ : nullptr);
    answers_.keep(out_);
    joint_states_.publish(out_);
    if (in_.stamp.seq % kBodyState_cycles == 0 && core_->body_state(body_)) body_states_.publish(body_);
    if (const std::string* note = misfit_note_.update(out_)) process_.set_standing_note(*note);
    return in_.stamp;
  }

  void resend(std::int64_t seq) override {
    for (const std::int64_t stored : {seq - 1, seq}) {
      if (const JointState* answer = answers_.find(stored)) joint_states_.publish(*answer);
    }
  }

  void restart() override {
    core_.emplace(robot_, watchdogs_);
    answers_.clear();
  }

 private:
  Process& process_;
  const RobotConfig& robot_;
  const WatchdogConfig& watchdogs_;
  DriveState in_{robot_.actuators.size()};
  JointState out_{robot_.joints.size(), robot_.legs.size()};
  Imu imu_;
  Slot<DriveState> drive_states_;
  Slot<Imu> imus_{imu_};  ///< stays empty where nobody publishes it
  AnswerStore<JointState> answers_;
  Publisher<JointState> joint_states_;
  BodyState body_;
  Publisher<BodyState> body_states_;
  std::optional<EstimatorCore> core_;
  MisfitNote misfit_note_{robot_};
};

int estimate(Process& process) {
  EstimatorShell shell(process);
  const auto responder = make_responder(process, {process.robot().body.imu, 0});
  return run_responder(process, *responder, shell);
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  return sprung::run_process(
      argc, argv,
      {"sprung-torque-estimator", "Joint torque, motion and contact from the drives' measurements."},
      sprung::estimate);
}
