#include "robots/robot_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

std::string shipped_text() {
  std::ifstream in(test::source_dir() + "/robots/single_leg/robot.yaml");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A folder with the shipped robot.yaml after one change; gone at the end.
class ChangedRobot : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "sprung_robot";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string complaint(const std::string& from, const std::string& to) {
    std::string text = shipped_text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(folder_ / "robot.yaml") << text;
    try {
      load_robot(folder_.string());
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
  fs::path folder_;
};

TEST(RobotLoader, ShippedSingleLegIsValid) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(robot.name, "single_leg");
  EXPECT_DOUBLE_EQ(robot.cycle_s, 0.001);
  ASSERT_EQ(robot.actuators.size(), 2u);
  EXPECT_EQ(robot.actuators[1].node, 2);
  EXPECT_EQ(robot.actuators[0].identity.vendor, 0x9Au);
  ASSERT_EQ(robot.legs.size(), 1u);
  EXPECT_EQ(robot.legs[0].joints, (std::vector<int>{0, 1}));
  EXPECT_EQ(robot.legs[0].links[1].length_m, 0.422);
  EXPECT_EQ(robot.preset("paper").jump_curve.lengths_m.size(), 7u);
  EXPECT_EQ(robot.watchdogs.heartbeat_consumer_s, 0.020);
}

TEST(RobotLoader, FrictionIsThePapersUntilIdentified) {
  for (const JointConfig& joint : load_robot("single_leg").joints) {
    EXPECT_DOUBLE_EQ(joint.coulomb_friction_Nm, 1.79) << joint.name;
    EXPECT_THAT(joint.friction_source, HasSubstr("S0"));
  }
}

TEST(RobotLoader, UnknownRobotNamesThoseThereAre) {
  try {
    load_robot("nobody");
    FAIL() << "an unknown robot was accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no robot 'nobody'"), HasSubstr("single_leg")));
  }
}

TEST(RobotLoader, UnknownPresetNamesThoseThereAre) {
  EXPECT_THAT(
      [] { (void)load_robot("single_leg").preset("worst"); },
      testing::ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("worst"), HasSubstr("paper, best"))));
}

TEST_F(ChangedRobot, UnknownKeyIsRefused) {
  EXPECT_THAT(complaint("gear_ratio: 100 ", "gear_ratio: 100\n    gear_color: red "),
              HasSubstr("gear_color' is unknown"));
}

TEST_F(ChangedRobot, MissingKeyIsRefused) {
  EXPECT_THAT(complaint("    gear_ratio: 100  ", "    # "), HasSubstr("actuators[0].gear_ratio' is missing"));
}

TEST_F(ChangedRobot, MissingUnitIsRefused) {
  EXPECT_THAT(complaint("torque_limit: 171.6 Nm", "torque_limit: 171.6"), HasSubstr("unit is missing"));
}

TEST_F(ChangedRobot, WrongUnitIsRefused) {
  EXPECT_THAT(complaint("torque_limit: 171.6 Nm", "torque_limit: 171.6 N"), HasSubstr("wrong unit 'N'"));
}

TEST_F(ChangedRobot, ImpossibleValueIsRefused) {
  EXPECT_THAT(complaint("gear_ratio: 100 ", "gear_ratio: 0 "), HasSubstr("out of range"));
  EXPECT_THAT(complaint("direction: 1\n", "direction: 0\n"), HasSubstr("expected 1 or -1"));
}

TEST_F(ChangedRobot, PowerLimitIsReadInWattsAndNoneByDefault) {
  EXPECT_EQ(load_robot("single_leg").actuators[0].power_limit_W, 0.0);
  EXPECT_EQ(complaint("torque_limit: 171.6 Nm", "power_limit: 400 W\n    torque_limit: 171.6 Nm"),
            "nothing was refused");
  const RobotConfig limited = load_robot(folder_.string());
  EXPECT_EQ(limited.actuators[0].power_limit_W, 400.0);
  EXPECT_EQ(limited.actuators[1].power_limit_W, 0.0);
  EXPECT_THAT(complaint("torque_limit: 171.6 Nm", "power_limit: 400 Nm\n    torque_limit: 171.6 Nm"),
              HasSubstr("wrong unit 'Nm'"));
  EXPECT_THAT(complaint("torque_limit: 171.6 Nm", "power_limit: 0 W\n    torque_limit: 171.6 Nm"),
              HasSubstr("out of range"));
}

TEST_F(ChangedRobot, SupplyAndEmergencyInputAreReadAndWatchNothingByDefault) {
  const auto with = [&](const std::string& line) {
    return complaint("torque_limit: 171.6 Nm", line + "\n    torque_limit: 171.6 Nm");
  };
  EXPECT_EQ(load_robot("single_leg").actuators[0].emergency_input.bit, -1);
  EXPECT_EQ(with("supply: {min: 40 V, max: 58 V}\n    emergency_input: {bit: 3, stops_at: 0}"),
            "nothing was refused");
  const ActuatorConfig read = load_robot(folder_.string()).actuators[0];
  EXPECT_EQ(read.supply.min_V, 40.0);
  EXPECT_EQ(read.supply.max_V, 58.0);
  EXPECT_EQ(read.emergency_input.bit, 3);
  EXPECT_FALSE(read.emergency_input.stops_high);
  EXPECT_THAT(with("supply: {min: 58 V, max: 40 V}"), HasSubstr("must be above min"));
  EXPECT_THAT(with("emergency_input: {bit: 32, stops_at: 0}"), HasSubstr("out of range"));
  EXPECT_THAT(with("emergency_input: {bit: 3, stops_at: 2}"),
              HasSubstr("expected 0 (what a cut wire gives) or 1"));
}

TEST_F(ChangedRobot, TwoDrivesOnOneNodeIdAreRefused) {
  EXPECT_THAT(complaint("node: 2", "node: 1"),
              AllOf(HasSubstr("hip_motor and knee_motor share node id 1"), HasSubstr("bus leg")));
}

TEST_F(ChangedRobot, UnknownNamesAreRefusedWithTheKnownOnes) {
  EXPECT_THAT(complaint("joints: [hip, knee]", "joints: [hip, ankle]"),
              AllOf(HasSubstr("'ankle' is not known"), HasSubstr("hip, knee")));
  EXPECT_THAT(complaint("bus: leg", "bus: arm"), HasSubstr("'arm' is not known"));
}

TEST_F(ChangedRobot, NamesThatStandTwiceAreRefused) {
  EXPECT_THAT(complaint("name: knee_motor", "name: hip_motor"), HasSubstr("'hip_motor' stands twice"));
}

TEST_F(ChangedRobot, LooseJointIsRefused) {
  EXPECT_THAT(complaint("joints: [hip, knee]", "joints: [hip, hip]"), HasSubstr("exactly one leg"));
}

TEST_F(ChangedRobot, TransmissionOfWrongSizeIsRefused) {
  EXPECT_THAT(complaint("transmission: [[1, 0], [0, 1]]", "transmission: [[1, 0]]"),
              HasSubstr("2 rows of 2 numbers"));
}

TEST_F(ChangedRobot, UnknownBusKindIsRefused) {
  EXPECT_THAT(complaint("udp:239.74.163.2:43113", "tcp:x"), HasSubstr("socketcan:IFACE"));
}

TEST_F(ChangedRobot, JointLimitsInWrongOrderAreRefused) {
  EXPECT_THAT(complaint("max: 3.7 rad", "max: -3.7 rad"), HasSubstr("must be above min"));
}

TEST(RobotLoader, PresetPaperCompensatesThePapersFrictionAndBestTheIdentified) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(robot.preset("paper").compensated_friction, CompensatedFriction::kPaper);
  EXPECT_EQ(robot.preset("best").compensated_friction, CompensatedFriction::kIdentified);
}

TEST(RobotLoader, UsualPresetIsBestElseTheOnlyOneElseOneMustBeChosen) {
  RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(robot.preset().name, "best");
  EXPECT_EQ(as_in_preset(robot, "").presets.size(), 2U);
  EXPECT_EQ(preset_or(robot, "paper"), "paper");
  EXPECT_EQ(preset_or(robot, "soft"), "best");
  EXPECT_EQ(preset_or(robot, "soft", "paper"), "paper");
  robot.presets[1].name = "soft";
  EXPECT_THAT([&] { (void)robot.preset(); },
              testing::ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("none is called best"), HasSubstr("--preset, one of: paper, soft"))));
  robot.presets.erase(robot.presets.begin());
  EXPECT_EQ(robot.preset().name, "soft");
  EXPECT_EQ(preset_or(robot, "paper"), "soft");
  EXPECT_THAT([&] { (void)robot.preset("best"); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("there are: soft")))
      << "what was asked is not replaced";
}

TEST(RobotLoader, UnderPresetPaperNothingIsIdentified) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints[1].friction.emplace();
  robot.joints[1].uncertainty.friction = 0.1;
  EXPECT_TRUE(as_in_preset(robot, "best").joints[1].friction.has_value());
  const RobotConfig paper = as_in_preset(robot, "paper");
  EXPECT_FALSE(paper.joints[1].friction.has_value());
  EXPECT_EQ(paper.joints[1].uncertainty.friction, kPapersFrictionUncertainty);
  EXPECT_THROW((void)as_in_preset(robot, "worst"), std::invalid_argument);
}

TEST(RobotLoader, RobotWithoutPresetsUsesWhatIsIdentified) {
  RobotConfig robot = load_robot("test_axis");
  robot.joints[0].friction.emplace();
  EXPECT_TRUE(as_in_preset(robot, "best").joints[0].friction.has_value());
}

TEST_F(ChangedRobot, UnknownCompensatedFrictionIsRefused) {
  EXPECT_THAT(complaint("compensated_friction: identified", "compensated_friction: all"),
              HasSubstr("expected paper or identified, found 'all'"));
}

TEST_F(ChangedRobot, AFileKeptThroughAnUpgradeIsHeldAgainstThePackagesOwn) {
  const std::string other = (folder_ / "robot.yaml.dpkg-dist").string();
  EXPECT_THAT(complaint("gear_ratio: 100 ", "gear_ration: 100 "), Not(HasSubstr("dpkg-dist")));
  std::ofstream(other) << "robot: single_leg\n";
  EXPECT_THAT(complaint("gear_ratio: 100 ", "gear_ration: 100 "),
              AllOf(HasSubstr("gear_ratio' is missing"),
                    HasSubstr("diff " + (folder_ / "robot.yaml").string() + " " + other)));
}

TEST_F(ChangedRobot, HashFollowsTheFile) {
  EXPECT_EQ(complaint("gear_ratio: 100 ", "gear_ratio: 101 "), "nothing was refused");
  EXPECT_NE(load_robot(folder_.string()).hash, load_robot("single_leg").hash);
}

TEST(RobotFolder, AnEmptyVariableIsAsGoodAsNone) {
  unsetenv("SPRUNG_ROBOTS");
  const std::string usual = robot_folder("single_leg");
  setenv("SPRUNG_ROBOTS", "", 1);
  EXPECT_EQ(robot_folder("single_leg"), usual);
  setenv("SPRUNG_ROBOTS", "/nowhere", 1);
  EXPECT_THROW(robot_folder("single_leg"), ConfigError);
  unsetenv("SPRUNG_ROBOTS");
}

TEST(RobotLoaderNumbers, ReplaceTheFilesAndGiveAnotherHash) {
  const RobotConfig file = load_robot("single_leg");
  const RobotConfig robot = load_robot("single_leg", {{"presets.best.stand_length", 0.44}});
  EXPECT_EQ(robot.preset("best").stand_length_m, 0.44);
  EXPECT_EQ(robot.preset("paper").stand_length_m, file.preset("paper").stand_length_m);
  EXPECT_NE(robot.hash, file.hash);
  EXPECT_EQ(robot.hash, load_robot("single_leg", {{"presets.best.stand_length", 0.44}}).hash);
  EXPECT_EQ(load_robot("single_leg", {}).hash, file.hash);
}

TEST(RobotLoaderNumbers, ThatTheFileHasNotOrMayNotHoldAreRefused) {
  EXPECT_THROW(load_robot("single_leg", {{"presets.best.nothing", 1.0}}), ConfigError);
  EXPECT_THROW(load_robot("single_leg", {{"presets.best.stand_length", -1.0}}), ConfigError);
}

TEST(RobotLoaderNumbers, ThatAnOverlayWouldHideAreRefused) {
  const test::OwnFolder folder("numbers");
  fs::copy(test::source_dir() + "/robots/single_leg/robot.yaml", folder.path());
  std::ofstream(folder / "overlay.yaml") << "presets: {best: {compliance: {stiffness: {z: 2500 N/m}}}}\n";
  try {
    load_robot(folder.path().string(), {{"presets.best.compliance.stiffness.z", 3000.0}});
    ADD_FAILURE() << "not refused";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("overlay.yaml"), HasSubstr("compliance.stiffness.z")));
  }
}

}  // namespace
}  // namespace sprung
