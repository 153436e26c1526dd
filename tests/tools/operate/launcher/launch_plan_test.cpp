#include "tools/operate/launcher/launch_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class LaunchPlan : public testing::Test {
 protected:
  std::vector<PlannedProcess> plan() const { return plan_processes(request_, robot_, 77, 12345); }
  const PlannedProcess& process(const std::vector<PlannedProcess>& all, const std::string& program) const {
    for (const PlannedProcess& one : all) {
      if (one.program == program) return one;
    }
    throw std::out_of_range(program);
  }
  std::string value(const PlannedProcess& planned, const std::string& option) const {
    for (std::size_t i = 0; i + 1 < planned.arguments.size(); ++i) {
      if (planned.arguments[i] == option) return planned.arguments[i + 1];
    }
    return "(absent)";
  }
  RobotConfig robot_ = load_robot("single_leg");
  LaunchRequest request_;
};

TEST_F(LaunchPlan, BridgeComesLastAndSimulatedDrivesFirst) {
  request_.simulation = true;
  const auto all = plan();
  EXPECT_EQ(all.front().program, "sprung-sim-drives");
  EXPECT_EQ(all.back().program, "sprung-can-bridge");
  EXPECT_EQ(all.size(), robot_.processes.size() + 1);
}

TEST_F(LaunchPlan, RealImuIsReadOnARealRobotAlone) {
  robot_.processes.push_back({"sprung-imu-driver", 40, -1, RestartPolicy::kNever, ""});
  const auto has_driver = [this] {
    const auto all = plan();
    return std::any_of(all.begin(), all.end(),
                       [](const PlannedProcess& p) { return p.program == "sprung-imu-driver"; });
  };
  EXPECT_TRUE(has_driver());
  request_.simulation = true;
  EXPECT_FALSE(has_driver()) << "simulated drives publish IMU";
  robot_.processes.back().host = "head";
  EXPECT_TRUE(remote_processes(request_, robot_).empty());
}

TEST_F(LaunchPlan, RealRobotHasNoSimulatedDrives) {
  for (const PlannedProcess& planned : plan()) {
    EXPECT_NE(planned.program, "sprung-sim-drives");
    EXPECT_THAT(planned.arguments, Not(Contains("--simulation")));
  }
}

TEST_F(LaunchPlan, EveryProcessGetsTheSameSessionAndEpoch) {
  for (const PlannedProcess& planned : plan()) {
    EXPECT_EQ(value(planned, "--session"), "77") << planned.program;
    EXPECT_EQ(value(planned, "--epoch-us"), "12345") << planned.program;
  }
}

TEST_F(LaunchPlan, ProcessesAreToldTheRobotsUsualPresetByName) {
  for (const PlannedProcess& planned : plan()) EXPECT_EQ(value(planned, "--preset"), "best");
  robot_.presets.resize(1);
  robot_.presets[0].name = "soft";
  for (const PlannedProcess& planned : plan()) EXPECT_EQ(value(planned, "--preset"), "soft");
  request_.preset = "best";
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("there are: soft")));
}

TEST_F(LaunchPlan, PriorityComesFromTheRobotFile) { EXPECT_EQ(value(plan().back(), "--priority"), "50"); }

TEST_F(LaunchPlan, PlantAndSeedReachTheSimulatedDrivesOnly) {
  request_.simulation = true;
  request_.seed = 9;
  request_.plant = {"friction_scale=1.2"};
  for (const PlannedProcess& planned : plan()) {
    const bool sim = planned.program == "sprung-sim-drives";
    EXPECT_EQ(value(planned, "--seed"), sim ? "9" : "(absent)") << planned.program;
    EXPECT_EQ(value(planned, "--plant"), sim ? "friction_scale=1.2" : "(absent)") << planned.program;
  }
}

TEST_F(LaunchPlan, InjectionReachesTheNamedProgramOnly) {
  request_.simulation = true;
  request_.inject = {"sprung-leg-controller=drop-rx:JOINT_STATE:100"};
  const auto all = plan();
  EXPECT_EQ(value(process(all, "sprung-leg-controller"), "--inject"), "drop-rx:JOINT_STATE:100");
  EXPECT_EQ(value(process(all, "sprung-motion-planner"), "--inject"), "(absent)");
}

TEST_F(LaunchPlan, FaultsWithoutSimulationAreRefused) {
  request_.inject = {"sprung-leg-controller=drop-rx:JOINT_STATE:100"};
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("add --sim")));
}

TEST_F(LaunchPlan, SimulationElsewhereStartsNoDrivesAndHasTheLongerWatchdogs) {
  request_.simulated_elsewhere = true;
  for (const PlannedProcess& planned : plan()) {
    EXPECT_NE(planned.program, "sprung-sim-drives");
    EXPECT_THAT(planned.arguments, Contains("--simulation")) << planned.program;
  }
  request_.simulation = true;
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("--sim-elsewhere")));
}

TEST_F(LaunchPlan, LockStepNeedsSimulatedDrives) {
  request_.clock = "lockstep";
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("needs --sim")));
}

TEST_F(LaunchPlan, PlantWithoutSimulationIsRefused) {
  request_.plant = {"friction_scale=1.2"};
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("add --sim")));
}

TEST_F(LaunchPlan, BridgeThatShouldComeBackIsRefused) {
  robot_.processes.back().restart = RestartPolicy::kWithoutTorque;
  ASSERT_EQ(robot_.processes.back().program, kBridgeProgram);
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("never comes back")));
}

TEST_F(LaunchPlan, OneProgramTwiceIsRefused) {
  robot_.processes.push_back(robot_.processes.front());
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(testing::AllOf(
                                   HasSubstr(robot_.processes.front().program), HasSubstr("twice"))));
}

TEST_F(LaunchPlan, UnknownPresetIsRefused) {
  request_.preset = "worst";
  EXPECT_THROW(plan(), std::invalid_argument);
}

class LaunchPlanOfTwoHosts : public LaunchPlan {
 protected:
  void SetUp() override {
    for (ProcessConfig& process : robot_.processes) {
      if (process.program == "sprung-motion-planner") process.host = "trunk";
    }
    request_.simulation = true;
    request_.key_file = "sprung.key";
  }
};

TEST_F(LaunchPlanOfTwoHosts, OneKeyIsNeededAndHowItGetsThereIsSaid) {
  request_.key_file.clear();
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(
                                   testing::AllOf(HasSubstr("scp -p"), HasSubstr("--key-file"))));
}

TEST_F(LaunchPlanOfTwoHosts, EachHostStartsItsOwn) {
  const auto lead = plan();
  EXPECT_EQ(lead.size(), robot_.processes.size());  // simulated drives more, planner less
  EXPECT_THROW(process(lead, "sprung-motion-planner"), std::out_of_range);
  EXPECT_TRUE(leads(request_, robot_));
  request_.host = "trunk";
  const auto trunk = plan();
  ASSERT_EQ(trunk.size(), 1u);
  EXPECT_EQ(trunk[0].program, "sprung-motion-planner");
  EXPECT_FALSE(leads(request_, robot_));
}

TEST_F(LaunchPlanOfTwoHosts, EachKnowsWhatItWaitsFor) {
  const auto remote = remote_processes(request_, robot_);
  ASSERT_EQ(remote.size(), 1u);
  EXPECT_EQ(remote[0].program, "sprung-motion-planner");
  EXPECT_EQ(remote[0].host, "trunk");
  request_.host = "trunk";
  EXPECT_EQ(remote_processes(request_, robot_).size(), robot_.processes.size() - 1);
}

TEST_F(LaunchPlanOfTwoHosts, UnknownHostIsRefusedAndTheKnownAreNamed) {
  request_.host = "tail";
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(
                                   testing::AllOf(HasSubstr("'tail'"), HasSubstr("trunk"))));
}

TEST_F(LaunchPlanOfTwoHosts, WhereAllHaveHostsOneMustBeNamed) {
  for (ProcessConfig& process : robot_.processes) process.host = "trunk";
  EXPECT_THAT([&] { plan(); }, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("--host")));
}

TEST_F(LaunchPlan, RestartPolicyComesFromTheRobotFile) {
  robot_.processes[0].restart = RestartPolicy::kWithoutTorque;
  EXPECT_EQ(process(plan(), robot_.processes[0].program).restart, RestartPolicy::kWithoutTorque);
  EXPECT_EQ(plan().back().restart, RestartPolicy::kNever);
}

}  // namespace
}  // namespace sprung
