#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "robots/robot_loader.h"
#include "robots/robot_sections.h"
#include "robots/yaml_reader.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

ProcessConfig process_section_read(const std::string& more) {
  return robot_sections::read_process(
      YamlMap::parse("program: sprung-motion-planner\npriority: 30\ncpu: 2\n" + more, "robot.yaml"));
}

TEST(ProcessSection, NothingComesBackAndEverythingIsHereUnlessTheFileSaysSo) {
  const ProcessConfig process = process_section_read("");
  EXPECT_EQ(process.program, "sprung-motion-planner");
  EXPECT_EQ(process.priority, 30);
  EXPECT_EQ(process.cpu, 2);
  EXPECT_EQ(process.restart, RestartPolicy::kNever);
  EXPECT_EQ(process.host, "");
}

TEST(ProcessSection, RestartAndHostAreRead) {
  const ProcessConfig process = process_section_read("restart: without_torque\nhost: trunk\n");
  EXPECT_EQ(process.restart, RestartPolicy::kWithoutTorque);
  EXPECT_EQ(process.host, "trunk");
  EXPECT_EQ(process_section_read("restart: never\n").restart, RestartPolicy::kNever);
}

TEST(ProcessSection, UnknownPolicyIsRefusedWithThoseThereAre) {
  EXPECT_THAT([] { process_section_read("restart: always\n"); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("always"), HasSubstr("never"), HasSubstr("without_torque"))));
}

TEST(ProcessSection, NoShippedRobotStartsItsBridgeAgain) {
  for (const char* name : {"single_leg", "pegasus", "fennec", "test_axis"}) {
    for (const ProcessConfig& process : load_robot(name).processes) {
      const bool bridge = process.program == "sprung-can-bridge";
      EXPECT_EQ(process.restart, bridge ? RestartPolicy::kNever : RestartPolicy::kWithoutTorque)
          << name << " " << process.program;
    }
  }
}

}  // namespace
}  // namespace sprung
