#include "tools/operate/doctor/real_time_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::doctor {
namespace {

using testing::HasSubstr;

class RealTimeChecks : public testing::Test {
 protected:
  RealTimeChecks() {
    kernel_.governors = {{"cpu0", "performance"}, {"cpu1", "performance"}};
    kernel_.cpus = {0, 1, 2, 3};
    kernel_.real_time = true;
    kernel_.clock_source = "tsc";
    kernel_.clock_sources = {"tsc", "hpet"};
    limits_ = {98, -1, false, true};
    utc_ = {true, 0.5};
    robot_.processes.resize(2);
    robot_.processes[0].priority = 60;
  }
  Check check(const std::string& name) const {
    for (const Check& one : real_time_checks(kernel_, limits_, utc_, &robot_)) {
      if (one.name == name) return one;
    }
    throw std::out_of_range(name);
  }
  KernelFacts kernel_;
  LimitFacts limits_;
  UtcFacts utc_;
  RobotConfig robot_;
};

TEST_F(RealTimeChecks, HealthyMachinePassesEverything) {
  EXPECT_EQ(worst(real_time_checks(kernel_, limits_, utc_, &robot_)), Verdict::kPass);
  EXPECT_EQ(worst(real_time_checks(kernel_, limits_, utc_, nullptr)), Verdict::kPass);
}

TEST_F(RealTimeChecks, OrdinaryKernelWarns) {
  kernel_.real_time = false;
  EXPECT_EQ(check("kernel").verdict, Verdict::kWarn);
  EXPECT_THAT(check("kernel").remedy, HasSubstr("linux-image-rt"));
}

TEST_F(RealTimeChecks, PriorityLimitIsHeldAgainstWhatTheRobotWants) {
  limits_.rtprio = 59;
  EXPECT_EQ(check("real-time priority").verdict, Verdict::kWarn);
  EXPECT_THAT(check("real-time priority").found, HasSubstr("wants 60"));
  EXPECT_THAT(check("real-time priority").remedy, HasSubstr("rtprio 98"));
  limits_.rtprio = 60;
  EXPECT_EQ(check("real-time priority").verdict, Verdict::kPass);
}

TEST_F(RealTimeChecks, UnlimitedPriorityIsEnough) {
  limits_.rtprio = -1;  // LimitRTPRIO=infinity
  EXPECT_EQ(check("real-time priority").verdict, Verdict::kPass);
  EXPECT_THAT(check("real-time priority").found, HasSubstr("unlimited"));
}

TEST_F(RealTimeChecks, LimitThatTheKernelDoesNotHonourWarns) {
  limits_.fifo_granted = false;
  EXPECT_EQ(check("real-time priority").verdict, Verdict::kWarn);
  EXPECT_THAT(check("real-time priority").remedy, HasSubstr("container"));
}

TEST_F(RealTimeChecks, SmallMemlockWarnsUnlessRoot) {
  limits_.memlock_bytes = 65'536;
  EXPECT_EQ(check("locked memory").verdict, Verdict::kWarn);
  EXPECT_THAT(check("locked memory").remedy, HasSubstr("memlock unlimited"));
  limits_.superuser = true;
  EXPECT_EQ(check("locked memory").verdict, Verdict::kPass);
}

TEST_F(RealTimeChecks, GovernorThatSavesPowerWarnsAndIsNamed) {
  kernel_.governors["cpu1"] = "powersave";
  EXPECT_EQ(check("CPU frequency").verdict, Verdict::kWarn);
  EXPECT_THAT(check("CPU frequency").found, HasSubstr("cpu1 has governor powersave"));
  EXPECT_THAT(check("CPU frequency").remedy, HasSubstr("scaling_governor"));
}

TEST_F(RealTimeChecks, FixedFrequencyPasses) {
  kernel_.governors.clear();
  EXPECT_EQ(check("CPU frequency").verdict, Verdict::kPass);
}

TEST_F(RealTimeChecks, PinnedCpusShouldBeIsolated) {
  robot_.processes[0].cpu = 2;
  robot_.processes[1].cpu = 3;
  kernel_.isolated_cpus = {3};
  EXPECT_EQ(check("CPUs").verdict, Verdict::kWarn);
  EXPECT_THAT(check("CPUs").remedy, HasSubstr("isolcpus=2,3"));
  kernel_.isolated_cpus = {2, 3};
  EXPECT_EQ(check("CPUs").verdict, Verdict::kPass);
}

TEST_F(RealTimeChecks, CpuThatIsNotThereFails) {
  robot_.processes[0].cpu = 4;
  EXPECT_EQ(check("CPUs").verdict, Verdict::kFail);
  EXPECT_THAT(check("CPUs").found, HasSubstr("CPU 4"));
}

TEST_F(RealTimeChecks, NumbersOfCpusThatAreOnlineNeedNotFollowEachOther) {
  kernel_.cpus = {0, 2, 4, 6};  // nosmt
  kernel_.isolated_cpus = {1, 6};
  robot_.processes[0].cpu = 6;
  EXPECT_EQ(check("CPUs").verdict, Verdict::kPass);
  robot_.processes[0].cpu = 1;
  EXPECT_EQ(check("CPUs").verdict, Verdict::kFail);
  EXPECT_THAT(check("CPUs").remedy, HasSubstr("0,2,4,6"));
}

TEST_F(RealTimeChecks, SlowClockWarnsWithWhatThereIs) {
  kernel_.clock_source = "hpet";
  EXPECT_EQ(check("clock").verdict, Verdict::kWarn);
  EXPECT_THAT(check("clock").remedy, HasSubstr("echo tsc >"));
  kernel_.clock_sources = {"hpet"};
  EXPECT_THAT(check("clock").remedy, HasSubstr("tsc=reliable"));
}

TEST_F(RealTimeChecks, UnsynchronisedUtcWarnsAndFailsWhereHostsCompareClocks) {
  utc_ = {false, 16'000.0};
  EXPECT_EQ(check("UTC").verdict, Verdict::kWarn);
  robot_.processes[1].host = "trunk";
  EXPECT_EQ(check("UTC").verdict, Verdict::kFail);
  utc_ = {true, 30.0};
  EXPECT_EQ(check("UTC").verdict, Verdict::kFail);
  EXPECT_THAT(check("UTC").remedy, HasSubstr("chrony"));
}

}  // namespace
}  // namespace sprung::doctor
