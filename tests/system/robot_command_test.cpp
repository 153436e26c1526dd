/// sprung robot show, new and check, and what sprung up does with files that disagree.
#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/changed_robot.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

class RobotCommand : public SystemTest {
 protected:
  void SetUp() override {
    SystemTest::SetUp();
    begun_ = sprung("robot new " + mine_ + " --from pegasus");
  }
  /// One text of the new robot's file becomes another.
  void change(const std::string& file, const std::string& from, const std::string& to) {
    std::ifstream in(mine_ + "/" + file);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    std::ofstream(mine_ + "/" + file) << test::replaced(text, from, to);
  }

  const std::string mine_ = (folder_ / "mine").string();
  CommandResult begun_;
};

TEST_F(RobotCommand, ANewRobotIsTheOneItWasBegunFromUnderItsOwnName) {
  EXPECT_EQ(begun_.status, 0) << begun_.output;
  EXPECT_THAT(begun_.output, HasSubstr("sprung robot check " + mine_));
  EXPECT_EQ(load_robot(mine_).name, "mine");
  EXPECT_EQ(load_robot(mine_).joints.size(), 12u);
  const CommandResult checked = sprung("robot check " + mine_);
  EXPECT_EQ(checked.status, 0) << checked.output;
  EXPECT_THAT(checked.output, HasSubstr("mine: robot.yaml agrees with model.xml and sim.yaml"));
  const CommandResult again = sprung("robot new " + mine_);
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.output, HasSubstr("holds a robot.yaml already"));
}

TEST_F(RobotCommand, ShowPrintsARobotThatLoadsWithThePlaceOfEachValue) {
  const CommandResult shown = sprung("robot show pegasus");
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.output, AllOf(ContainsRegex("\n  - name: hr_knee_motor +# robot.yaml:[0-9]+\n"),
                                  ContainsRegex("\n    # power_limit: 0 W +.default.\n"),
                                  HasSubstr("# hr_knee: mirror image of fl_knee")));
  EXPECT_EQ(read_robot_text(shown.output, "shown").actuators[11].link_encoder.offset_rad, -1.8416);
  EXPECT_THAT(sprung("robot show pegasus --sim").output,
              ContainsRegex("actuator: hr_knee_motor +# sim.yaml:"));
}

TEST_F(RobotCommand, ShowPrintsWhatADrawChanges) {
  const CommandResult shown = sprung("robot show " + mine_ + " --sim --plant draw=3 --plant family=erob_50");
  EXPECT_EQ(shown.status, 0) << shown.output;
  EXPECT_THAT(shown.output, AllOf(ContainsRegex("\nfl_knee.coulomb: [0-9.]+ Nm\n"),
                                  ContainsRegex("\nfl_thigh.mass_factor: [0-9.]+\n"),
                                  ContainsRegex("\nlatency: [0-9.]+ s\n")));
  EXPECT_EQ(sprung("robot show pegasus --sim --plant mass_scale=1.1").status, 2);
}

TEST_F(RobotCommand, UpStartsNothingWhereTheFilesDisagree) {
  change("robot.yaml", "body: {mass: 12 kg", "body: {mass: 1.2 kg");
  const CommandResult checked = sprung("robot check " + mine_);
  EXPECT_EQ(checked.status, 1);
  EXPECT_THAT(checked.output, ContainsRegex("the trunk weighs: 1.2 kg in .*robot.yaml:[0-9]+, 12 kg in "));
  const CommandResult refused = sprung("up " + mine_ + " --sim --no-record");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("the trunk weighs"), HasSubstr("nothing was started"),
                                    HasSubstr("--unchecked")));
}

TEST_F(RobotCommand, ARealRobotsModelIsCheckedAndItsPlantIsNot) {
  change("sim.yaml", "{name: base, mass: 12.0 kg}", "{name: base, mass: 1.2 kg}");
  EXPECT_EQ(sprung("robot check " + mine_).status, 1);
  const CommandResult real = sprung("robot check --real " + mine_);
  EXPECT_EQ(real.status, 0) << real.output;
  EXPECT_THAT(real.output, HasSubstr("agrees with model.xml\n"));
}

}  // namespace
}  // namespace sprung
