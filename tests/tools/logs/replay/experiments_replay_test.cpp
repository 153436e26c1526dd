/// Logs of experiments and of pegasus' demo, replayed into the cores: the same bits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

#include "robots/parameters.h"
#include "tests/support/paths.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/lab/gait/legged_trial.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/leg/step_response.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {
namespace {

using test::Folder;

OperatorCommand trot(const RobotConfig& robot, const Vec3& speed) {
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = gait_index(robot, "trot");
  walk.walk_speed = speed;
  return walk;
}

class ExperimentsReplay : public testing::Test {
 protected:
  std::vector<std::string> logs() const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".lcm") out.push_back(entry.path().string());
    }
    std::sort(out.begin(), out.end());
    return out;
  }
  void expect_identical(std::size_t count) {
    ASSERT_EQ(logs().size(), count);
    for (const std::string& log : logs()) {
      ReplayRequest request;
      request.log = log;
      const ReplayResult result = run_replay(request);
      EXPECT_TRUE(result.identical())
          << log << ": "
          << (result.differences.first() ? result.differences.first()->text("in the log", "now")
                                         : "nothing compared");
    }
  }

  const Folder folder_{"experiments-replay"};
};

TEST_F(ExperimentsReplay, JumpInEveryMode) {
  const RobotConfig robot = load_robot("single_leg");
  std::size_t count = 0;
  {
    const test::LogsOf logs(folder_.path().string());
    for (const JumpMode mode : {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid}) {
      test::run(jump_script(robot, "paper", SimOptions{1, {}, true}, mode, 1));
      ++count;
    }
    test::run(jump_script(robot, "best", SimOptions{1, {}, true}, JumpMode::kAdaptive, 1));
    ++count;
  }
  expect_identical(count);
}

TEST_F(ExperimentsReplay, StepResponse) {
  SimOptions sim;
  sim.seed = 1;
  std::size_t count = 0;
  {
    const test::LogsOf logs(folder_.path().string());
    run_step_response(load_robot("single_leg"), "paper", sim, run_in_process);
    count = this->logs().size();
  }
  ASSERT_GT(count, 0u);
  expect_identical(count);
}

/// Of parameters too: the ones that an overlay has, and the ones that are set on the way.
TEST_F(ExperimentsReplay, PegasusWhoseParametersChangeWhileItTrots) {
  std::filesystem::copy(test::source_dir() + "/robots/pegasus", folder_.path() / "pegasus",
                        std::filesystem::copy_options::recursive);
  std::ofstream(folder_.path() / "pegasus/overlay.yaml") << "presets: {best: {walk: {force_rise: 50 ms}}}\n";
  const RobotConfig robot = load_robot(folder_.path() / "pegasus");
  ASSERT_EQ(robot.overlay.size(), 1u);
  {
    const test::LogsOf logs(folder_.path().string());
    LeggedTrial trial(robot, "best", lying(SimOptions{1, {}, true}));
    trial.stand_up();
    trial.say(trot(robot, {0.3, 0.0, 0.0}));
    trial.run(1.5);
    OperatorCommand set;
    set.kind = OperatorKind::kSetParameter;
    for (const auto& [name, value] :
         {std::pair{"walk.stance.stiffness.z", 3000.0}, std::pair{"gaits.trot.fastest.forward", 0.15}}) {
      set.parameter = parameter_id(name);
      set.parameter_value = value;
      trial.say(set);
      trial.run(0.7);
    }
    EXPECT_LT(trial.robot().motion_state().desired_speed[0], 0.3);
  }
  expect_identical(1);
}

/// From the floor to its feet, a trot that turns, another speed, stop.
TEST_F(ExperimentsReplay, PegasusGetsUpWalksAndStops) {
  const RobotConfig robot = load_robot("pegasus");
  {
    const test::LogsOf logs(folder_.path().string());
    LeggedTrial trial(robot, "best", lying(SimOptions{1, {}, true}));
    trial.stand_up();
    trial.say(trot(robot, {0.2, 0.0, 0.1}));
    trial.run(2.0);
    trial.say(trot(robot, {0.1, 0.0, 0.0}));
    trial.run(1.0);
    OperatorCommand stop;
    stop.kind = OperatorKind::kStop;
    trial.say(stop);
    trial.run(1.5);
  }
  expect_identical(1);
  ReplayRequest changed;
  changed.log = logs().front();
  changed.preset = "no such preset";
  EXPECT_THROW(run_replay(changed), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
