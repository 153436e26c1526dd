#include "runtime/process_options.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "runtime/key_source.h"
#include "tests/support/enumerators.h"

namespace sprung {
namespace {

ProcessOptions parsed(std::vector<const char*> words) {
  ProcessOptions options;
  CommandLine line("process", "A process.");
  add_process_options(line, options);
  words.insert(words.begin(), "process");
  EXPECT_EQ(line.run(static_cast<int>(words.size()), words.data()), kExitDone);
  return options;
}

TEST(ProcessOptions, WordsOfTheCommandLineAreTheirOwn) {
  test::expect_own_names<ClockMode>();
  test::expect_own_names<RealTimePolicy>();
}

TEST(ProcessOptions, DefaultsAreTheRobotsOwnNetworkAndClock) {
  const ProcessOptions options = parsed({"--session", "5"});
  EXPECT_EQ(options.robot, "single_leg");
  EXPECT_EQ(options.node.session, 5);
  EXPECT_EQ(options.node.lcm_url, kDefaultLcmUrl);
  EXPECT_EQ(options.clock_mode(), ClockMode::kRealTime);
  EXPECT_EQ(options.real_time().policy, RealTimePolicy::kWarn);
}

TEST(ProcessOptions, FaultsAreMadeOnSimulatedRobotsAlone) {
  EXPECT_NO_THROW(refuse_injection(parsed({"--session", "5"})));
  EXPECT_NO_THROW(refuse_injection(parsed({"--session", "5", "--inject", "drop-rx:A:1", "--simulation"})));
  EXPECT_NO_THROW(
      refuse_injection(parsed({"--session", "5", "--inject", "drop-rx:A:1", "--clock", "lockstep"})));
  EXPECT_THROW(refuse_injection(parsed({"--session", "5", "--inject", "drop-rx:A:1"})), WrongUse);
}

TEST(ProcessOptions, WithoutAKeyNothingThatMayMoveDrivesStarts) {
  unsetenv(kKeyFdVariable);
  EXPECT_THROW(key_of(parsed({"--session", "5"})), WrongUse);
  EXPECT_THROW(key_of(parsed({"--session", "5", "--clock", "lockstep"})), WrongUse);
  EXPECT_THROW(key_of(parsed({"--session", "5", "--no-key"})), WrongUse);
  EXPECT_EQ(key_of(parsed({"--session", "5", "--no-key", "--simulation"})), nullptr);
  EXPECT_EQ(key_of(parsed({"--session", "5", "--no-key", "--clock", "lockstep"})), nullptr);
}

TEST(ProcessOptions, KeyComesByTheDescriptorThatIsNamed) {
  const auto key = random_key();
  const KeyFd fd(*key);
  const auto copy = [&] { return std::to_string(dup(fd.number())); };
  const std::string named = copy();
  EXPECT_EQ(key_of(parsed({"--session", "5", "--key-fd", named.c_str()}))->bytes(), key->bytes());
  setenv(kKeyFdVariable, copy().c_str(), 1);
  EXPECT_EQ(key_of(parsed({"--session", "5"}))->bytes(), key->bytes()) << "as sprung run hands it on";
  unsetenv(kKeyFdVariable);
  EXPECT_THROW(key_of(parsed({"--session", "5", "--key-fd", "999"})), std::runtime_error);
}

TEST(ProcessOptions, ReadsAllThatTheLauncherGives) {
  const ProcessOptions options = parsed(
      {"--robot",   "x",       "--preset", "paper",       "--session",   "-7",          "--epoch-us",  "99",
       "--lcm-url", "memq://", "--clock",  "realtime",    "--rt-policy", "enforce",     "--priority",  "45",
       "--cpu",     "1",       "--inject", "drop-rx:A:1", "--inject",    "drop-tx:B:2", "--simulation"});
  EXPECT_EQ(options.robot, "x");
  EXPECT_EQ(options.preset, "paper");
  EXPECT_EQ(options.node.session, -7);
  EXPECT_EQ(options.node.epoch_us, 99);
  EXPECT_EQ(options.node.lcm_url, "memq://");
  EXPECT_EQ(options.node.inject.size(), 2U);
  EXPECT_TRUE(options.simulation);
  const RealTimeRequest request = options.real_time();
  EXPECT_EQ(request.policy, RealTimePolicy::kEnforce);
  EXPECT_EQ(request.priority, 45);
  EXPECT_EQ(request.cpu, 1);
}

TEST(ProcessOptions, LockstepAsksForNoRealTime) {
  const ProcessOptions options = parsed({"--session", "5", "--clock", "lockstep", "--rt-policy", "enforce"});
  EXPECT_EQ(options.clock_mode(), ClockMode::kLockstep);
  EXPECT_EQ(options.real_time().policy, RealTimePolicy::kOff);
}

TEST(ProcessOptions, PolicyOffAsksForNothing) {
  EXPECT_EQ(parsed({"--session", "5", "--rt-policy", "off"}).real_time().policy, RealTimePolicy::kOff);
}

TEST(ProcessOptions, LongerWatchdogsOnlyForSimulationInRealTime) {
  RobotConfig robot;
  robot.watchdogs.joint_state_s = 1.0;
  robot.simulation_watchdogs.joint_state_s = 2.0;
  ProcessOptions options;
  EXPECT_EQ(watchdogs_for(robot, options).joint_state_s, 1.0);
  options.simulation = true;
  EXPECT_EQ(watchdogs_for(robot, options).joint_state_s, 2.0);
  options.clock = "lockstep";
  EXPECT_EQ(watchdogs_for(robot, options).joint_state_s, 1.0);
}

TEST(ProcessOptions, ConfigurationHashKnowsFileAndPreset) {
  RobotConfig robot;
  robot.hash = 1;
  const std::int64_t paper = configuration_hash(robot, "paper");
  EXPECT_EQ(configuration_hash(robot, "paper"), paper);
  EXPECT_NE(configuration_hash(robot, "best"), paper);
  robot.hash = 2;
  EXPECT_NE(configuration_hash(robot, "paper"), paper);
}

}  // namespace
}  // namespace sprung
