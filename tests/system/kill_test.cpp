/// SIGKILL in the middle of a jump: the drives are damped and then off, with the cause named, and nothing
/// switches them on again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "drivers/can/can_bus.h"
#include "drivers/cia402/words.h"
#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using Clock = std::chrono::steady_clock;

/// Everything that the safety of a run shows, as it comes.
class Witness {
 public:
  Witness(const RunInfo& info, std::size_t actuators, std::size_t legs)
      : drive_states_(DriveState(actuators)),
        drive_commands_(DriveCommand(actuators)),
        node_(NodeOptions{info.lcm_url, info.session, info.epoch_us, {}}) {
    node_.subscribe(channels::kDriveState, CountLimits::exactly(actuators), drive_states_);
    node_.subscribe(channels::kDriveCommand, CountLimits::exactly(actuators), drive_commands_);
    node_.subscribe_message(channels::kSafetyState, CountLimits::none(), safeties_);
    node_.subscribe_message(channels::kMotionState, CountLimits::exactly(legs), motions_);
    node_.start();
  }
  ~Witness() { node_.stop(); }

  void look() {
    node_.wait_for_input(node_.utime_us() + 20'000);
    while (auto safety = safeties_.pop()) {
      levels.push_back(static_cast<SafetyLevel>(safety->level));
      cause = static_cast<SafetyCause>(safety->cause);
      latched = safety->latched != 0;
    }
    while (auto motion = motions_.pop()) {
      const auto phase = static_cast<MotionPhase>(motion->state);
      jumped = jumped || phase == MotionPhase::kThrust || phase == MotionPhase::kFlight;
    }
    DriveState state;
    if (drive_states_.newest(state)) {
      enabled = false;
      for (const ActuatorState& actuator : state.actuators) {
        enabled = enabled || actuator.power_state == PowerState::kOperationEnabled;
      }
    }
  }
  template <class Condition>
  bool until(Condition condition, double timeout_s = 60.0) {
    const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
    while (!condition()) {
      if (Clock::now() > end) return false;
      look();
    }
    return true;
  }
  bool all_commanded(DriveMode mode) const {
    DriveCommand command;
    return drive_commands_.newest(command) &&
           std::all_of(command.actuators.begin(), command.actuators.end(),
                       [&](const ActuatorCommand& actuator) { return actuator.mode == mode; });
  }
  bool saw(SafetyLevel level) const { return std::find(levels.begin(), levels.end(), level) != levels.end(); }

  std::vector<SafetyLevel> levels;
  SafetyCause cause = SafetyCause::kNone;
  bool jumped = false;  ///< it thrusts, flies, or has done so
  bool latched = false;
  bool enabled = false;

 private:
  Slot<DriveState> drive_states_;
  Slot<DriveCommand> drive_commands_;
  InputQueue<sprung_msgs::safety_state_t> safeties_{4096};
  InputQueue<sprung_msgs::motion_state_t> motions_{1 << 16};
  Node node_;
};

class Kill : public SystemTest, public testing::WithParamInterface<const char*> {
 protected:
  void jump_into(Witness& witness) {
    ASSERT_EQ(sprung("stand").status, 0);
    ASSERT_EQ(sprung("jump --no-wait").status, 0);
    ASSERT_TRUE(witness.until([&] { return witness.jumped; }));
    ASSERT_TRUE(witness.until([&] { return witness.enabled; }));
  }
  /// Slow enough in lock-step that the kill falls into the jump; should it be late, what must happen is the
  /// same.
  std::string pace() const { return std::string(GetParam()) == "lockstep" ? "--speed 1" : ""; }
};

TEST_P(Kill, DeadControllerIsDampedThenOffAndStaysOff) {
  up(GetParam(), pace());
  Witness witness(info(), robot_.actuators.size(), robot_.legs.size());
  jump_into(witness);
  kill_program("sprung-leg-controller");
  EXPECT_TRUE(witness.until([&] { return witness.saw(SafetyLevel::kDamping); })) << "never damped";
  EXPECT_TRUE(witness.until([&] { return !witness.enabled; })) << "never off";
  EXPECT_TRUE(witness.until([&] { return witness.latched; }));
  EXPECT_EQ(witness.cause, SafetyCause::kCommandStale);
  for (int i = 0; i < 50; ++i) {
    witness.look();
    ASSERT_FALSE(witness.enabled) << "something switched the drives on again";
  }
  EXPECT_NE(sprung("stand").status, 0);
}

TEST_P(Kill, DeadPlannerIsNamedAndTheRobotDampedThenOff) {
  up(GetParam(), pace());
  Witness witness(info(), robot_.actuators.size(), robot_.legs.size());
  jump_into(witness);
  kill_program("sprung-motion-planner");
  EXPECT_TRUE(witness.until([&] { return witness.all_commanded(DriveMode::kDamping); })) << "never damped";
  EXPECT_TRUE(witness.until([&] { return witness.latched; }));
  EXPECT_EQ(witness.cause, SafetyCause::kPlannerLost);
  EXPECT_TRUE(witness.until([&] { return !witness.enabled; })) << "never off";
}

TEST_P(Kill, DeadEstimatorIsDampedThenOff) {
  up(GetParam(), pace());
  Witness witness(info(), robot_.actuators.size(), robot_.legs.size());
  jump_into(witness);
  kill_program("sprung-torque-estimator");
  EXPECT_TRUE(witness.until([&] { return witness.saw(SafetyLevel::kDamping); })) << "never damped";
  EXPECT_TRUE(witness.until([&] { return !witness.enabled && witness.latched; })) << "never off";
  EXPECT_EQ(witness.cause, SafetyCause::kCommandStale);
}

TEST_P(Kill, DeadPlannerOfAnIdleRobotSwitchesNothingOn) {
  up(GetParam(), pace());
  Witness witness(info(), robot_.actuators.size(), robot_.legs.size());
  kill_program("sprung-motion-planner");
  for (int i = 0; i < 100; ++i) {
    witness.look();
    ASSERT_FALSE(witness.enabled);
  }
  ASSERT_EQ(sprung("estop").status, 0);
  ASSERT_EQ(sprung("clear").status, 0);
  for (int i = 0; i < 100; ++i) {
    witness.look();
    ASSERT_FALSE(witness.enabled) << "clear switched the drives on";
  }
}

/// What a drive says on the bus when its master is gone.
class BusWitness {
 public:
  BusWitness(const std::string& address, const RobotConfig& robot)
      : bus_(open_can_bus(address)),
        robot_(robot),
        emergency_(robot.actuators.size(), 0),
        status_(robot.actuators.size(), -1) {}

  /// Waits for every drive's heartbeat emergency, then asks each for its status word.
  bool every_drive_gave_up() {
    return until([&] { return std::count(emergency_.begin(), emergency_.end(), 0x8130) == drives(); });
  }
  bool every_drive_is_off() {
    ask_status();
    return until([&] {
      return std::all_of(status_.begin(), status_.end(), [](int word) {
        return word >= 0 &&
               cia402::decode_status(static_cast<std::uint16_t>(word)) != PowerState::kOperationEnabled;
      });
    });
  }

 private:
  std::ptrdiff_t drives() const { return static_cast<std::ptrdiff_t>(robot_.actuators.size()); }
  void ask_status() {
    ask_again_ = Clock::now() + std::chrono::milliseconds(100);
    for (const ActuatorConfig& actuator : robot_.actuators) {
      const CanFrame question{0x600u + static_cast<unsigned>(actuator.node), 8, {0x40, 0x41, 0x60, 0x00}};
      bus_->send(&question, 1);
    }
  }
  template <class Condition>
  bool until(Condition condition) {
    const auto end = Clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      if (Clock::now() > end) {
        for (std::size_t i = 0; i < status_.size(); ++i) {
          std::printf("%s: emergency %04X, status word %04X\n", robot_.actuators[i].name.c_str(),
                      emergency_[i], status_[i]);
        }
        return false;
      }
      pollfd fd{bus_->fd(), POLLIN, 0};
      poll(&fd, 1, 50);
      for (CanFrame frame; bus_->receive(&frame, 1) == 1;) take(frame);
      if (Clock::now() > ask_again_) ask_status();
    }
    return true;
  }
  void take(const CanFrame& frame) {
    for (std::size_t i = 0; i < emergency_.size(); ++i) {
      const auto node = static_cast<unsigned>(robot_.actuators[i].node);
      if (frame.id == 0x80u + node) emergency_[i] = frame.data[0] | frame.data[1] << 8;
      const bool answer = frame.id == 0x580u + node && frame.data[1] == 0x41 && frame.data[2] == 0x60;
      if (answer) status_[i] = frame.data[4] | frame.data[5] << 8;
    }
  }

  std::unique_ptr<CanBus> bus_;
  Clock::time_point ask_again_ = Clock::time_point::max();  ///< not before the first question
  const RobotConfig& robot_;
  std::vector<int> emergency_;
  std::vector<int> status_;
};

TEST_P(Kill, DeadBridgeIsNoticedByTheDrivesWhichSwitchOff) {
  up(GetParam(), pace());
  Witness witness(info(), robot_.actuators.size(), robot_.legs.size());
  jump_into(witness);
  BusWitness drives(can_address(), robot_);
  kill_program("sprung-can-bridge");
  EXPECT_TRUE(drives.every_drive_gave_up()) << "no EMCY 0x8130, heartbeat lost";
  EXPECT_TRUE(drives.every_drive_is_off());
}

INSTANTIATE_TEST_SUITE_P(BothClocks, Kill, testing::Values("lockstep", "realtime"),
                         [](const testing::TestParamInfo<const char*>& clock) { return clock.param; });

}  // namespace
}  // namespace sprung
