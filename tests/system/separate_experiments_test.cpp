/// `--separate` of the leg's experiments: real processes, commanded as an operator would, leave the same bits
/// as one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "tests/system/system_fixture.h"
#include "tools/lab/landing/drop.h"
#include "tools/lab/leg/foot_return.h"
#include "tools/lab/leg/step_response.h"
#include "tools/lab/run/separate_run.h"

namespace sprung {
namespace {

class SeparateExperiments : public SystemTest {
 protected:
  static SimOptions sim() { return SimOptions{5, {}, true}; }
  static ParallelOptions one_job() { return {1, {}}; }
};

void expect_same(const std::vector<PlanePoint>& a, const std::vector<PlanePoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].x_m, b[k].x_m) << k;
    ASSERT_EQ(a[k].z_m, b[k].z_m) << k;
  }
}

TEST_F(SeparateExperiments, FootReturnBringsTheFootHomeBetweenPullsAndGivesTheSameBits) {
  FootReturnCase config = foot_return_cases(robot_.preset("best")).front();
  config.script.pulls = {config.script.pulls[2], config.script.pulls[13]};
  const auto pulled = [&](bool separate) {
    return run_foot_return(robot_, "best", sim(), {config}, script_runner(separate), one_job()).cases.front();
  };
  const FootReturnCaseResult one = pulled(false);
  ASSERT_EQ(one.pulls.size(), 2u);
  ASSERT_GT(one.summary.moved_least_mm, 30.0);
  const FootReturnCaseResult many = pulled(true);
  ASSERT_EQ(many.traces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    expect_same(one.traces[i].foot_m, many.traces[i].foot_m);
    EXPECT_EQ(one.traces[i].commanded_Nm, many.traces[i].commanded_Nm);
  }
}

TEST_F(SeparateExperiments, StepResponseGivesTheSameBits) {
  const auto stepped = [&](bool separate) {
    return run_step_response(robot_, "paper", sim(), script_runner(separate), one_job());
  };
  const StepResponseResult one = stepped(false);
  const StepResponseResult many = stepped(true);
  ASSERT_EQ(one.cases.size(), many.cases.size());
  for (std::size_t i = 0; i < one.cases.size(); ++i) {
    ASSERT_FALSE(one.cases[i].knee.output_Nm.empty());
    EXPECT_EQ(one.cases[i].knee.output_Nm, many.cases[i].knee.output_Nm) << one.cases[i].config.name;
    EXPECT_EQ(one.cases[i].knee.estimated_motor_side_Nm, many.cases[i].knee.estimated_motor_side_Nm);
  }
}

TEST_F(SeparateExperiments, DropGivesTheSameBits) {
  const RunScript script = drop_script(robot_, "best", sim(), {JumpMode::kAdaptive, 0.3, 0.004});
  const DropResult one = run_drop(script, script_runner(false));
  ASSERT_GT(one.touchdown_speed_m_s, 0.0);
  const DropResult many = run_drop(script, script_runner(true));
  EXPECT_EQ(one.peak_motor_torque_Nm, many.peak_motor_torque_Nm);
  EXPECT_EQ(one.peak_output_torque_Nm, many.peak_output_torque_Nm);
  EXPECT_EQ(one.touchdown_s, many.touchdown_s);
  EXPECT_EQ(one.touchdown_speed_m_s, many.touchdown_speed_m_s);
  EXPECT_EQ(one.shortest_m, many.shortest_m);
  EXPECT_EQ(one.folded, many.folded);
}

/// What a run says whose process holds still for so long in cycle 100; nothing when nobody notices.
std::string said_when_stalled(const RunScript& script, const std::string& program, int stop_ms) {
  std::string instance;
  SeparateOptions options;
  options.on_ready = [&](const RunInfo& info) { instance = info.instance; };
  const auto stall_once = [&](const CycleRecord& cycle) {
    if (cycle.drive_state.stamp.seq != 100) return;
    const auto run = read_run_file(instance);  // has the bridge, too, which begins after the others
    ASSERT_TRUE(run);
    for (const RunningProcess& process : run->processes) {
      if (process.program != program) continue;
      kill(static_cast<pid_t>(process.pid), SIGSTOP);
      std::this_thread::sleep_for(std::chrono::milliseconds(stop_ms));
      kill(static_cast<pid_t>(process.pid), SIGCONT);
    }
  };
  try {
    run_separate(
        script, stall_once, [](const OperatorReply&) {}, options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// The leg controller waits for 300 ms of wall time.
TEST_F(SeparateExperiments, RunWhosePlannerStallsFailsSinceItIsNotDeterministic) {
  const RunScript script = drop_script(robot_, "best", sim(), {JumpMode::kAdaptive, 0.3, 0.004});
  // Whichever is found first: cycles that the planner made from older messages, or those that it never heard.
  EXPECT_THAT(said_when_stalled(script, "sprung-motion-planner", 600),
              testing::AnyOf(testing::HasSubstr("this run is not deterministic"),
                             testing::HasSubstr("were lost on the way here")));
}

/// The simulated drives wait for a second, and no cycle shows that they went on.
TEST_F(SeparateExperiments, RunWhoseBridgeStallsFailsSinceItIsNotDeterministic) {
  const RunScript script = drop_script(robot_, "best", sim(), {JumpMode::kAdaptive, 0.3, 0.004});
  EXPECT_THAT(said_when_stalled(script, "sprung-can-bridge", 1500),
              testing::AllOf(testing::HasSubstr("sprung-sim-drives: no SYNC"),
                             testing::HasSubstr("this run is not deterministic")));
}

}  // namespace
}  // namespace sprung
