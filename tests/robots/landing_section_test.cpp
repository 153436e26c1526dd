#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "robots/preset_section.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// The shipped single_leg with one text replaced; gone at the end.
class ChangedLanding : public testing::Test {
 protected:
  ChangedLanding() : folder_(test::temp_dir() + "sprung_landing") { fs::create_directories(folder_); }
  ~ChangedLanding() override { fs::remove_all(folder_); }

  std::string complaint(const std::string& from, const std::string& to) {
    std::ifstream in(test::source_dir() + "/robots/single_leg/robot.yaml");
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
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

 private:
  fs::path folder_;
};

TEST(LandingSection, ShippedPresetBestHasALandingOfItsOwnAndPaperNone) {
  const RobotConfig robot = load_robot("single_leg");
  const AdaptiveLandingConfig& best = robot.preset("best").adaptive_landing;
  EXPECT_GT(best.extended_length_m, best.shortest_m);
  EXPECT_GT(best.braking_m_s2, 0.0);
  EXPECT_EQ(robot.preset("paper").adaptive_landing.extended_length_m, 0.0);
}

TEST_F(ChangedLanding, LegThatIsToEndLongerThanItStretchesIsRefused) {
  EXPECT_THAT(complaint("shortest: 0.27 m", "shortest: 0.70 m"),
              AllOf(HasSubstr("robot.yaml"), HasSubstr("shortest")));
}

TEST_F(ChangedLanding, WrongUnitIsRefused) {
  EXPECT_THAT(complaint("approach_speed: 1.0 m/s", "approach_speed: 1.0 m"), HasSubstr("approach_speed"));
}

TEST_F(ChangedLanding, MissingKeyIsNamed) {
  EXPECT_THAT(complaint("      force_rise: 0.045 s\n", ""), HasSubstr("force_rise"));
}

TEST_F(ChangedLanding, MassMustBeSaidInTheAirAndOnTheGround) {
  EXPECT_THAT(complaint("        mass: {x: 12 kg, z: 7 kg}\n", ""),
              HasSubstr("adaptive_landing.ground.mass"));
  EXPECT_THAT(complaint("mass: {x: 0 kg, z: 12 kg}", "mass: {x: 0 kg, z: -1 kg}"), HasSubstr("air.mass.z"));
}

TEST_F(ChangedLanding, UnknownKeyIsNamed) {
  EXPECT_THAT(complaint("force_rise: 0.045 s", "force_rise: 0.045 s\n      force_fall: 0.1 s"),
              HasSubstr("force_fall"));
}

}  // namespace
}  // namespace sprung
