/// What a package sets on a machine is what `sprung doctor` asks of it, for every robot that is shipped.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "tests/support/paths.h"
#include "tools/operate/doctor/network_checks.h"
#include "tools/operate/doctor/real_time_checks.h"
#include "tools/operate/doctor/robot_checks.h"

namespace sprung::doctor {
namespace {

const std::vector<std::string> kRobots = {"fennec", "pegasus", "single_leg", "test_axis"};

/// Lines of a file below tools/install/system that are no comments.
std::string settings(const std::string& file) {
  std::ifstream in(test::source_dir() + "/tools/install/system/" + file);
  std::string text;
  for (std::string line; std::getline(in, line);)
    if (line.rfind('#', 0) != 0) text += line + "\n";
  return text;
}

/// The first group of the pattern.
std::string found(const std::string& text, const std::string& pattern) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern << " in\n" << text;
  return match.size() > 1 ? match[1].str() : "";
}

Check named(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& check : checks)
    if (check.name == name) return check;
  return fail(name, "there is no such check", "");
}

TEST(SystemFiles, ReceiveBufferIsWhatDoctorAsksFor) {
  KernelFacts kernel;
  kernel.receive_buffer_bytes = std::stoll(
      found(settings("30-sprung-sysctl.conf"), R"(net\.core\.rmem_max = (\d+))"));
  const LoopbackFacts loopback{kDefaultLcmUrl, 1, 1, ""};
  EXPECT_EQ(named(network_checks(kernel, loopback, nullptr), "receive buffer").verdict, Verdict::kPass);
  kernel.receive_buffer_bytes -= 1;
  EXPECT_EQ(named(network_checks(kernel, loopback, nullptr), "receive buffer").verdict, Verdict::kWarn);
}

TEST(SystemFiles, LimitsOfTheGroupAreEnoughForEveryRobot) {
  const std::string text = settings("30-sprung-limits.conf");
  EXPECT_EQ(found(text, R"(@sprung - memlock (\w+))"), "unlimited");
  const std::int64_t priority = std::stoll(found(text, R"(@sprung - rtprio (\d+))"));
  EXPECT_EQ(found(settings("sprung-sysusers.conf"), R"(^u (\w+) -)"), "sprung");
  for (const std::string& name : kRobots) {
    const RobotConfig robot = load_robot(name);
    const auto checks = real_time_checks({}, {priority, -1, false, true}, {}, &robot);
    EXPECT_EQ(named(checks, "real-time priority").verdict, Verdict::kPass) << name;
    EXPECT_EQ(named(checks, "locked memory").verdict, Verdict::kPass) << name;
  }
}

TEST(SystemFiles, CanInterfacesAreSetUpForEveryRobot) {
  const std::string rules = settings("70-sprung.rules");
  InterfaceFacts facts{"can0", "can", "ERROR-ACTIVE", true, 0, 0, 0};
  facts.restart_ms = std::stoi(found(rules, R"(restart-ms (\d+))"));
  facts.queue_length = std::stoi(found(rules, R"(txqueuelen (\d+) up)"));
  std::ifstream in(test::source_dir() + "/tools/install/system/machine.env");
  const std::string machine{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  facts.bit_rate = std::stoi(found(machine, R"(\n#SPRUNG_CAN_BIT_RATE=(\d+)\n)"));
  EXPECT_EQ(settings("machine.env"), "") << "a machine changes only when somebody asks for it";
  for (const std::string& name : kRobots) {
    const RobotConfig robot = load_robot(name);
    for (const BusConfig& bus : robot.buses)
      EXPECT_EQ(can_checks({{bus.name, "can0", facts}}, robot).front().verdict, Verdict::kPass)
          << name << ", " << bus.name << ": " << can_checks({{bus.name, "can0", facts}}, robot).front().found;
  }
}

TEST(SystemFiles, GovernorIsTheOneThatDoctorAsksFor) {
  std::ifstream in(test::source_dir() + "/tools/install/system/machine.env");
  const std::string machine{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  KernelFacts kernel;
  kernel.governors = {{"cpu0", found(machine, R"(\n#SPRUNG_CPU_GOVERNOR=(\w+)\n)")}};
  EXPECT_EQ(named(real_time_checks(kernel, {}, {}, nullptr), "CPU frequency").verdict, Verdict::kPass);
}

}  // namespace
}  // namespace sprung::doctor
