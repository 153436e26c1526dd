#include "tools/lab/identify/identified_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "drivers/profiles/drive_profile.h"
#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/identify/identify_sample.h"

namespace sprung::identify {
namespace {

using testing::HasSubstr;

/// The knee of a robot, identified from a recording that was weighed.
IdentifiedJoint weighed_joint(const std::string& name, double factor) {
  IdentifiedJoint out = sample_joint(sample_series({}, 0.1));
  out.name = name;
  out.torque_constant = TorqueConstant{factor, 0.01, true};
  return out;
}

TEST(IdentifiedRobot, FolderLoadsWithWhatWasFoundAndAllElseAsItWas) {
  const RobotConfig robot = load_robot("pegasus");
  const IdentifiedJoint knee = weighed_joint("fl_knee", 1.05);
  const RobotChange change = change_of(robot, knee, sample_provenance());
  const std::string folder = test::temp_dir() + "identified_pegasus";
  std::filesystem::remove_all(folder);
  write_identified_robot(robot, {change}, folder);
  const RobotConfig loaded = load_robot(folder);
  const std::size_t at = 2;
  ASSERT_EQ(loaded.joints[at].name, "fl_knee");
  EXPECT_NEAR(loaded.joints[at].friction->parameters.coulomb_Nm, change.joint.friction->parameters.coulomb_Nm,
              1e-12);
  EXPECT_EQ(loaded.joints[at].friction->record.log, sample_provenance().file);
  EXPECT_DOUBLE_EQ(loaded.actuators[at].torque_constant_Nm_A,
                   1.05 * robot.actuators[at].torque_constant_Nm_A);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (j == at) continue;
    EXPECT_DOUBLE_EQ(loaded.joints[j].armature_kg_m2, robot.joints[j].armature_kg_m2) << j;
    EXPECT_EQ(loaded.joints[j].friction->record.sha256, robot.joints[j].friction->record.sha256) << j;
    EXPECT_EQ(loaded.actuators[j].torque_constant_Nm_A, robot.actuators[j].torque_constant_Nm_A) << j;
  }
  EXPECT_EQ(loaded.gaits.size(), robot.gaits.size());
  EXPECT_TRUE(std::filesystem::exists(folder + "/sim.yaml"));
}

/// pegasus' 108 Nm take all that its drives give: with a weaker motor they would refuse to start.
TEST(IdentifiedRobot, NeitherTheMotorsCurrentNorTheGearsTorqueGrows) {
  const RobotConfig robot = load_robot("pegasus");
  const std::string folder = test::temp_dir() + "identified_weak_and_strong";
  const RobotChange weak = change_of(robot, weighed_joint("fl_knee", 0.9), sample_provenance());
  const RobotChange strong = change_of(robot, weighed_joint("fr_knee", 1.1), sample_provenance());
  write_identified_robot(robot, {weak, strong}, folder);
  const RobotConfig loaded = load_robot(folder);
  EXPECT_DOUBLE_EQ(loaded.actuators[2].torque_limit_Nm, 0.9 * robot.actuators[2].torque_limit_Nm);
  EXPECT_EQ(loaded.actuators[5].torque_limit_Nm, robot.actuators[5].torque_limit_Nm);
  for (const ActuatorConfig& actuator : loaded.actuators)
    EXPECT_NO_THROW((void)make_profile(actuator, timing_of(loaded.cycle_s, loaded.watchdogs)))
        << actuator.name;
}

TEST(IdentifiedRobot, TorqueConstantThatWasNotWeighedStays) {
  const RobotConfig robot = load_robot("single_leg");
  IdentifiedJoint knee = weighed_joint("knee", 1.05);
  knee.torque_constant->by_known_weight = false;
  EXPECT_EQ(change_of(robot, knee, sample_provenance()).actuator, "");
}

TEST(IdentifiedRobot, FrictionIsScaledWithTheTorqueConstantThatWasWeighed) {
  const RobotConfig robot = load_robot("single_leg");
  IdentifiedJoint knee = weighed_joint("knee", 1.1);
  const double scaled_Nm = change_of(robot, knee, sample_provenance()).joint.friction->parameters.coulomb_Nm;
  knee.torque_constant.reset();
  const double as_read_Nm = change_of(robot, knee, sample_provenance()).joint.friction->parameters.coulomb_Nm;
  EXPECT_NEAR(scaled_Nm, 1.1 * as_read_Nm, 1e-9);
}

TEST(IdentifiedRobot, FolderThatHoldsARobotIsNotWrittenOver) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_THAT(test::refusal_of<std::runtime_error>([&] { write_identified_robot(robot, {}, robot.folder); }),
              HasSubstr("name another folder"));
}

TEST(IdentifiedRobot, JointThatTheFileDoesNotHaveIsNamed) {
  RobotChange change;
  change.joint = load_robot("single_leg").joints[0];
  change.joint.name = "elbow";
  EXPECT_THAT(test::refusal_of<ConfigError>(
                  [&] { (void)with_identified("joints:\n  - {name: hip}\n", "robot.yaml", {change}); }),
              HasSubstr("robot.yaml: joints has no 'elbow'"));
}

}  // namespace
}  // namespace sprung::identify
