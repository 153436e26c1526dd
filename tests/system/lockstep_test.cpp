/// The proof of the seams: separate processes in lock-step and one process give the same bits, with noise on
/// and a jump inside, also when datagrams are lost or come twice on every path.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "signals/messages.h"
#include "tests/system/system_fixture.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/separate_run.h"

namespace sprung {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Signal>
void append(const Signal& signal, Bytes& bytes) {
  MessageOf<Signal> message;
  to_message(signal, 0, message);
  const std::size_t at = bytes.size();
  bytes.resize(at + static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data() + at, 0, message.getEncodedSize());
}

/// Every cycle's encoded messages, by channel.
struct Recording {
  std::vector<Bytes> drive_commands;
  std::vector<Bytes> others;  ///< DRIVE_STATE, JOINT_STATE, MOTION_STATE, SIM_TRUTH
  bool flew = false;
  bool complied = false;
  int walked_cycles = 0;
  int imu_cycles = 0;  ///< in which the estimator used one

  void add(const CycleRecord& cycle) {
    drive_commands.emplace_back();
    append(cycle.drive_command, drive_commands.back());
    MotionState motion = cycle.motion_state;
    motion.last_transition = "";  // texts are not collected
    others.emplace_back();
    append(cycle.drive_state, others.back());
    append(cycle.joint_state, others.back());
    append(motion, others.back());
    append(cycle.truth, others.back());
    if (cycle.joint_state.body.uses_imu) ++imu_cycles;
    flew = flew || cycle.motion_state.state == MotionPhase::kFlight;
    if (cycle.motion_state.state == MotionPhase::kWalking) ++walked_cycles;
    complied = complied || cycle.motion_state.state == MotionPhase::kComplying;
  }
};

class Lockstep : public SystemTest {
 protected:
  RunScript script() const {
    return jump_script(robot_, "best", SimOptions{3, {}, true}, JumpMode::kHybrid, 1);
  }
  /// @param least_repeats proof that the injected losses happened: each makes the bridge ask again.
  Recording separate(const std::vector<std::string>& inject = {}, std::int64_t least_repeats = 0) const {
    return separate(script(), inject, least_repeats);
  }
  Recording separate(const RunScript& run, const std::vector<std::string>& inject,
                     std::int64_t least_repeats) const {
    Recording recording;
    const SeparateResult result = run_separate(
        run, [&](const CycleRecord& cycle) { recording.add(cycle); }, [](const OperatorReply&) {},
        SeparateOptions{inject});
    EXPECT_GE(result.repeats, least_repeats);
    return recording;
  }
  Recording in_process(const RunScript& run) const {
    Recording recording;
    run_in_process(
        run, [&](const CycleRecord& cycle) { recording.add(cycle); }, [](const OperatorReply&) {});
    return recording;
  }
  void expect_same(const Recording& a, const Recording& b) const {
    ASSERT_EQ(a.drive_commands.size(), b.drive_commands.size());
    for (std::size_t k = 0; k < a.drive_commands.size(); ++k) {
      ASSERT_EQ(a.drive_commands[k], b.drive_commands[k]) << "DRIVE_COMMAND differs first in cycle " << k;
      ASSERT_EQ(a.others[k], b.others[k]) << "another channel differs first in cycle " << k;
    }
  }
};

TEST_F(Lockstep, SeparateProcessesGiveTheBitsOfOneProcess) {
  const Recording one = in_process(script());
  ASSERT_GE(one.drive_commands.size(), 2000u);
  ASSERT_TRUE(one.flew);
  expect_same(one, separate());
}

/// The hand is a SIM_CONTROL, which nobody acknowledges.
TEST_F(Lockstep, CompliantLegThatAFootPullsGivesTheSameBitsToo) {
  RunScript run{robot_, "best", SimOptions{3, {{"suspended", 1.5}}, true}, {}, 3000};
  run.commands.push_back(scripted(OperatorKind::kStand, 100));
  run.commands.push_back(scripted(OperatorKind::kComply, 2000));
  RunScript left_alone = run;
  SimControl pull;
  pull.kind = SimControlKind::kWrench;
  pull.actuator = 0;
  pull.apply_at_seq = 2300;
  pull.wrench = {120.0, 0.0, 40.0};
  pull.value = 0.3;
  pull.duration_s = 0.5;
  run.controls = {pull};
  const Recording one = in_process(run);
  const Recording alone = in_process(left_alone);
  ASSERT_TRUE(one.complied);
  EXPECT_EQ(one.others[2299], alone.others[2299]);
  EXPECT_NE(one.others[2700], alone.others[2700]);
  expect_same(one, separate(run, {}, 0));
}

TEST_F(Lockstep, JointsMovedOneByOneGiveTheSameBitsToo) {
  RunScript run{robot_, "best", SimOptions{3, {{"suspended", 0.8}}, true}, {}, 3000};
  const auto move = [&](std::int64_t at_seq, int joint, double target_rad) {
    run.commands.push_back(scripted(OperatorKind::kMoveJoint, at_seq));
    run.commands.back().joint = joint;
    run.commands.back().joint_target_rad = target_rad;
    run.commands.back().joint_speed_rad_s = 3.0;
    run.commands.back().joint_acceleration_rad_s2 = 20.0;
  };
  move(100, 1, 1.2);
  move(1000, 0, 2.0);
  run.commands.push_back(scripted(OperatorKind::kStop, 1200));
  run.commands.push_back(scripted(OperatorKind::kSit, 1700));
  double knee_rad = 0.0;
  run_in_process(
      run,
      [&](const CycleRecord& cycle) {
        if (cycle.drive_state.stamp.seq == 1690) knee_rad = cycle.truth.joints[1].true_position_rad;
      },
      [](const OperatorReply&) {});
  EXPECT_NEAR(knee_rad, 1.2, 0.03);
  expect_same(in_process(run), separate(run, {}, 0));
}

TEST_F(Lockstep, LostAndRepeatedLcmMessagesChangeNoBit) {
  const Recording one = in_process(script());
  expect_same(
      one,
      separate(
          {"sprung-can-bridge=drop-tx:DRIVE_STATE:300", "sprung-can-bridge=repeat-tx:DRIVE_STATE:310",
           "sprung-torque-estimator=drop-rx:DRIVE_STATE:320",
           "sprung-torque-estimator=drop-tx:JOINT_STATE:330",
           "sprung-torque-estimator=repeat-tx:JOINT_STATE:340",
           "sprung-leg-controller=drop-rx:JOINT_STATE:350", "sprung-motion-planner=drop-rx:JOINT_STATE:360",
           "sprung-motion-planner=drop-tx:LEG_COMMAND:370", "sprung-motion-planner=repeat-tx:LEG_COMMAND:380",
           "sprung-leg-controller=drop-rx:LEG_COMMAND:390",
           "sprung-leg-controller=drop-tx:DRIVE_COMMAND:3500",
           "sprung-leg-controller=repeat-tx:DRIVE_COMMAND:3510",
           "sprung-can-bridge=drop-rx:DRIVE_COMMAND:3520"},
          9));
}

TEST_F(Lockstep, LostAndRepeatedCanDatagramsChangeNoBit) {
  const Recording one = in_process(script());
  expect_same(one, separate({"sprung-can-bridge=can-drop:5:0", "sprung-can-bridge=can-drop:600:0",
                             "sprung-can-bridge=can-drop:601:2", "sprung-can-bridge=can-repeat:602:1",
                             "sprung-sim-drives=can-drop:7:0", "sprung-sim-drives=can-drop:610:0",
                             "sprung-sim-drives=can-drop:611:1", "sprung-sim-drives=can-repeat:612:0"},
                            6));
}

/// A robot with an IMU: the estimator waits for IMU(k).
class LockstepWithImu : public Lockstep {
 protected:
  LockstepWithImu() { robot_ = load_robot("pegasus"); }
  RunScript standing() const {
    RunScript run{robot_, "best", SimOptions{3, {}, true}, {}, 400};
    run.commands.push_back(scripted(OperatorKind::kStand, 50));
    return run;
  }
  static SimControl imu(std::int64_t apply_at_seq, double value) {
    SimControl control;
    control.kind = SimControlKind::kImu;
    control.apply_at_seq = apply_at_seq;
    control.value = value;
    return control;
  }
};

/// pegasus whose motors know their zeros: a script cannot home it, since only the bridge obeys that.
class LockstepWalk : public LockstepWithImu {
 protected:
  void SetUp() override {
    LockstepWithImu::SetUp();
    const std::filesystem::path changed = folder_ / "pegasus";
    std::filesystem::copy(robot_.folder, changed);
    replace_all(changed / "robot.yaml", "referenced: false", "referenced: true");
    replace_all(changed / "robot.yaml", "encoder: incremental", "encoder: absolute");
    replace_all(changed / "sim.yaml", "encoder: incremental", "encoder: absolute");
    robot_ = load_robot(changed.string());
  }
  int gait(const std::string& name) const {
    for (std::size_t i = 0; i < robot_.gaits.size(); ++i) {
      if (robot_.gaits[i].name == name) return static_cast<int>(i);
    }
    throw std::runtime_error("no gait " + name);
  }

 private:
  static void replace_all(const std::filesystem::path& file, const std::string& from, const std::string& to) {
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    ASSERT_NE(text.find(from), std::string::npos) << file;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    std::ofstream(file) << text;
  }
};

/// From the floor: stand, a trot that turns and is pushed, stop.
TEST_F(LockstepWalk, WalkingGivesTheBitsOfOneProcess) {
  RunScript run{robot_, "best", SimOptions{3, {}, true}, {}, 3500};
  run.commands.push_back(scripted(OperatorKind::kStand, 50));
  run.commands.push_back(scripted(OperatorKind::kWalk, 1500));
  run.commands.back().gait = gait("trot");
  run.commands.back().walk_speed = {0.2, 0.0, 0.1};
  run.commands.push_back(scripted(OperatorKind::kStop, 2800));
  SimControl push;
  push.kind = SimControlKind::kWrench;
  push.actuator = -1;
  push.apply_at_seq = 2300;
  push.wrench = {0.0, 50.0, 0.0};
  push.duration_s = 0.1;
  run.controls = {push};
  const Recording one = in_process(run);
  EXPECT_GT(one.walked_cycles, 1400);  // the last steps after the stop too
  expect_same(one, separate(run, {}, 0));
}

TEST_F(LockstepWithImu, LostImuMessagesChangeNoBit) {
  const Recording one = in_process(standing());
  ASSERT_EQ(one.imu_cycles, static_cast<int>(one.others.size()) - 1);  // nothing is measured in the first
  expect_same(one,
              separate(standing(),
                       {"sprung-torque-estimator=drop-rx:IMU:0", "sprung-torque-estimator=drop-rx:IMU:100",
                        "sprung-sim-drives=drop-tx:IMU:200", "sprung-sim-drives=repeat-tx:IMU:210",
                        "sprung-torque-estimator=drop-rx:DRIVE_STATE:220"},
                       0));
}

TEST_F(LockstepWithImu, ImuThatFailsAndComesBackGivesTheSameBits) {
  RunScript run = standing();
  run.controls = {imu(100, 1), imu(150, 2), imu(200, 3), imu(250, 0)};
  const Recording one = in_process(run);
  const int silent = 50 - 5, faulty = 50;
  EXPECT_EQ(one.imu_cycles, static_cast<int>(one.others.size()) - 1 - silent - faulty);
  expect_same(one, separate(run, {}, 0));
}

TEST_F(LockstepWithImu, SimulationWithoutTheImuThatTheRobotHasDoesNotHang) {
  RunScript run = standing();
  run.sim.plant = {{"imu", 0.0}};
  const Recording one = in_process(run);
  EXPECT_EQ(one.imu_cycles, 0);
  expect_same(one, separate(run, {}, 0));
}

TEST_F(Lockstep, TruthSwitchedOffChangesNoBit) {
  RunScript blind = script();
  blind.sim.truth = false;
  const Recording with = in_process(script());
  const Recording without = in_process(blind);
  EXPECT_EQ(with.drive_commands, without.drive_commands);
}

TEST_F(Lockstep, AnotherSeedIsAnotherRun) {
  RunScript other = script();
  other.sim.seed = 4;
  EXPECT_NE(in_process(script()).drive_commands, in_process(other).drive_commands);
}

}  // namespace
}  // namespace sprung
