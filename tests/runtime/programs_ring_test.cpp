/// Estimator, planner and leg controller as the real programs, in lock-step around a test that plays the
/// bridge.
#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "runtime/process_status.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/leg_command.h"
#include "signals/operator.h"
#include "tests/runtime/child.h"
#include "tests/runtime/lcm_network.h"
#include "tests/signals/message_bytes.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using test::Child;

constexpr std::int64_t kProgramsRingSession = 815;
constexpr std::int64_t kRepeat_us = 50'000;  ///< as the bridge repeats
constexpr std::int64_t kProgramsRingLong_us = 20'000'000;
using Bytes = std::vector<std::uint8_t>;
using Faults = std::vector<std::string>;

class Programs {
 public:
  Programs(const std::string& clock, const Faults& faults)
      : repeat_us_(clock == "lockstep" ? kRepeat_us : kProgramsRingLong_us),
        node_({url_, kProgramsRingSession, 0, {}}) {
    node_.subscribe(channels::kDriveCommand, CountLimits::exactly(2), commands_);
    node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
    node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
    receiving_ = std::make_unique<Receiving>(node_);
    for (const char* program :
         {"sprung-leg-controller", "sprung-motion-planner", "sprung-torque-estimator"}) {
      std::vector<std::string> words{test::bin_dir() + "/" + program,
                                     "--robot",
                                     test::source_dir() + "/robots/single_leg",
                                     "--session",
                                     std::to_string(kProgramsRingSession),
                                     "--lcm-url",
                                     url_,
                                     "--rt-policy",
                                     "off",
                                     "--no-key",
                                     "--simulation",
                                     "--clock",
                                     clock};
      for (const std::string& fault : faults) words.insert(words.end(), {"--inject", fault});
      children_.push_back(std::make_unique<Child>(words));
    }
    await_ready();
  }

  Node& node() { return node_; }
  Slot<DriveCommand>& commands() { return commands_; }
  std::optional<sprung_msgs::operator_reply_t> reply() { return replies_.pop(); }
  void send(std::int64_t seq) { drive_states_.publish(drive_state(seq)); }
  void send(const OperatorCommand& command) {
    node_.publisher<OperatorCommand>(channels::kOperatorCommand).publish(command);
  }
  /// @return whether that process' status comes to say so within the next seconds.
  bool await_detail(const std::string& process, const std::string& detail) {
    for (const std::int64_t end_us = node_.utime_us() + kProgramsRingLong_us; node_.utime_us() < end_us;) {
      while (const auto status = statuses_.pop()) {
        if (status->process == process && status->detail == detail) return true;
      }
      node_.wait_for_input(node_.utime_us() + 10'000);
    }
    return false;
  }
  /// A message that every process refuses.
  void send_as_another_session() {
    Node({url_, kProgramsRingSession + 1, 0, {}})
        .publisher<DriveState>(channels::kDriveState)
        .publish(drive_state(0));
    Node({url_, kProgramsRingSession + 1, 0, {}})
        .publisher<LegCommand>(channels::kLegCommand)
        .publish(LegCommand(1));
  }
  void kill(std::size_t child) { children_.at(child).reset(); }

  /// One cycle as the bridge paces it. @return the bytes of DRIVE_COMMAND(seq).
  Bytes cycle(std::int64_t seq) {
    DriveCommand command(2);
    for (const std::int64_t end_us = node_.utime_us() + kProgramsRingLong_us; node_.utime_us() < end_us;) {
      send(seq);
      for (const std::int64_t again_us = node_.utime_us() + repeat_us_; node_.utime_us() < again_us;) {
        if (commands_.get(seq, command)) return encoded(command);
        node_.wait_for_input(again_us);
      }
    }
    ADD_FAILURE() << "no DRIVE_COMMAND " << seq;
    return {};
  }

  std::vector<Bytes> run(std::int64_t cycles) {
    std::vector<Bytes> result;
    for (std::int64_t seq = 0; seq < cycles && !::testing::Test::HasFailure(); ++seq)
      result.push_back(cycle(seq));
    return result;
  }

  /// @return true when every program ended orderly.
  bool stop() {
    bool orderly = true;
    for (const auto& child : children_) child->signal(SIGTERM);
    for (const auto& child : children_) orderly = child->wait() == 0 && orderly;
    return orderly;
  }

 private:
  static Bytes encoded(const DriveCommand& command) {
    sprung_msgs::drive_command_t message{};
    to_message(command, kProgramsRingSession, message);
    return test::encoded(message);
  }

  static DriveState drive_state(std::int64_t seq) {
    DriveState state(2);
    state.stamp = {1000 * seq, seq};
    for (ActuatorState& actuator : state.actuators) {
      actuator.measured_position_rad = 1.0 + 1e-4 * static_cast<double>((seq * seq) % 17);
      actuator.measured_current_A = 0.5;
      actuator.power_state = PowerState::kOperationEnabled;
      actuator.shown_mode = DriveMode::kTorque;
      actuator.referenced = true;
    }
    state.safety = SafetyLevel::kOperational;
    return state;
  }

  void await_ready() {
    std::set<std::string> ready;
    for (const std::int64_t end_us = node_.utime_us() + kProgramsRingLong_us; ready.size() < 3;) {
      ASSERT_LT(node_.utime_us(), end_us) << "programs do not become ready";
      node_.wait_for_input(node_.utime_us() + 10'000);
      while (const auto status = statuses_.pop()) {
        if (status->state == static_cast<std::int8_t>(ProcessState::kReady)) ready.insert(status->process);
      }
    }
  }

  const std::string url_ = test::own_lcm_url();
  const std::int64_t repeat_us_;  ///< in real time a bridge never asks twice
  Slot<DriveCommand> commands_{DriveCommand(2)};
  InputQueue<sprung_msgs::operator_reply_t> replies_;
  InputQueue<sprung_msgs::process_status_t> statuses_{1000};
  Node node_;
  std::unique_ptr<Receiving> receiving_;
  Publisher<DriveState> drive_states_ = node_.publisher<DriveState>(channels::kDriveState);
  std::vector<std::unique_ptr<Child>> children_;
};

OperatorCommand stand_at(std::int64_t seq) {
  OperatorCommand command;
  command.request_id = 42;
  command.kind = OperatorKind::kStand;
  command.apply_at_seq = seq;
  return command;
}

TEST(ProgramsRing, LostAndRepeatedMessagesChangeNoBit) {
  constexpr std::int64_t kCycles = 250;
  const Faults faults{"drop-rx:LEG_COMMAND:110",   "drop-tx:LEG_COMMAND:120",   "drop-tx:JOINT_STATE:130",
                      "drop-rx:JOINT_STATE:140",   "drop-rx:DRIVE_STATE:150",   "drop-tx:DRIVE_COMMAND:160",
                      "repeat-tx:JOINT_STATE:170", "repeat-tx:LEG_COMMAND:180", "repeat-tx:DRIVE_COMMAND:190",
                      "drop-tx:LEG_COMMAND:200",   "drop-tx:JOINT_STATE:201",   "drop-tx:DRIVE_COMMAND:201"};
  std::vector<std::vector<Bytes>> runs;
  for (const Faults& injected : {Faults{}, faults}) {
    Programs programs("lockstep", injected);
    programs.send(stand_at(100));
    runs.push_back(programs.run(kCycles));
    DriveCommand last(2);
    ASSERT_TRUE(programs.commands().newest(last));
    EXPECT_EQ(last.actuators[0].mode, DriveMode::kPosition);  // rising: the planner's commands have arrived
    EXPECT_TRUE(programs.stop());
  }
  ASSERT_EQ(runs[0].size(), static_cast<std::size_t>(kCycles));
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(ProgramsRing, OperatorCommandIsAnsweredByThePlanner) {
  Programs programs("lockstep", {});
  programs.run(200);  // until the estimator has settled
  programs.send(stand_at(-1));
  programs.node().wait_for_input(programs.node().utime_us() + 20'000);
  std::optional<sprung_msgs::operator_reply_t> reply;
  for (std::int64_t seq = 200; seq < 400 && !reply; ++seq) {
    programs.cycle(seq);
    reply = programs.reply();
  }
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->request_id, 42);
  EXPECT_EQ(reply->outcome, static_cast<std::int8_t>(OperatorOutcome::kAccepted)) << reply->reason;
}

TEST(ProgramsRing, ControllerGoesOnAndDampsWhenThePlannerDies) {
  Programs programs("lockstep", {});
  programs.run(10);
  programs.kill(1);
  for (std::int64_t seq = 10; seq < 80; ++seq) programs.cycle(seq);  // 20 ms of message time is the limit
  DriveCommand command(2);
  ASSERT_TRUE(programs.commands().newest(command));
  EXPECT_EQ(command.stamp.seq, 79);
  EXPECT_EQ(command.used_joint_state_seq, 79);
  for (const ActuatorCommand& actuator : command.actuators) EXPECT_EQ(actuator.mode, DriveMode::kDamping);
}

TEST(ProgramsRing, ControllersStatusSaysWhyItsCommandIsWhatItIs) {
  Programs programs("lockstep", {});
  programs.send_as_another_session();  // a refusal is told too, but does not hide what comes later
  programs.run(10);
  EXPECT_TRUE(programs.await_detail("sprung-leg-controller", "commanded"));
  programs.kill(1);
  for (std::int64_t seq = 10; seq < 80; ++seq) programs.cycle(seq);
  EXPECT_TRUE(programs.await_detail("sprung-leg-controller", "leg command stale"));
}

TEST(ProgramsRing, InRealTimeTheControllerFallsSilentWhenItsInputsStop) {
  Programs programs("realtime", {});
  for (std::int64_t seq = 0; seq < 5; ++seq) programs.cycle(seq);
  for (const std::int64_t end_us = programs.node().utime_us() + 300'000;
       programs.node().utime_us() < end_us;) {
    programs.node().wait_for_input(programs.node().utime_us() + 10'000);
  }
  DriveCommand last(2);
  ASSERT_TRUE(programs.commands().newest(last));
  EXPECT_EQ(last.stamp.seq, 4);
  EXPECT_EQ(programs.commands().take_repeated(), std::nullopt);  // what follows is the bridge's watchdog's
}

}  // namespace
}  // namespace sprung
