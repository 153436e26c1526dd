#include "tools/station/scene/logged_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::station {
namespace {

using testing::HasSubstr;

sprung_msgs::log_metadata_t metadata_of(const std::string& yaml) {
  sprung_msgs::log_metadata_t metadata{};
  metadata.robot_yaml = yaml;
  return metadata;
}

TEST(LoggedScene, IsThatOfTheInstalledModel) {
  const std::string yaml = log::robot_yaml("single_leg");
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml));
  ASSERT_TRUE(found.scene);
  EXPECT_EQ((*found.scene)["robot"], "single_leg");
  EXPECT_EQ(found.note, "");
  EXPECT_THAT(found.model_xml, HasSubstr("<mujoco model=\"single_leg\">"));
}

TEST(LoggedScene, OfAFileWithOtherNumbersThanLengthsComesWithoutANote) {
  const std::string yaml = log::robot_yaml("single_leg", "landing_hold: 0.3 s", "landing_hold: 0.4 s");
  EXPECT_EQ(scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml)).note, "");
}

TEST(LoggedScene, OfAFileWithOtherLengthsComesWithANote) {
  const std::string yaml = log::robot_yaml("single_leg", "0.260 m", "0.261 m");
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml));
  EXPECT_TRUE(found.scene);
  EXPECT_THAT(found.note, HasSubstr("other lengths than this log's"));
}

TEST(LoggedScene, HasTheGroundOfTheWorldThatTheLogsCommandNames) {
  const std::string yaml = log::robot_yaml("pegasus");
  sprung_msgs::log_metadata_t metadata = metadata_of(yaml);
  metadata.command_line = "sprung up pegasus --sim --world stairs --plain";
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata);
  ASSERT_TRUE(found.scene);
  const auto& ground = (*found.scene)["ground"];
  const int columns = ground["columns"], lines = ground["lines"];
  ASSERT_EQ(ground["heights_mm"].size(), static_cast<std::size_t>(columns * lines));
  const auto height_mm = [&](double x_m) -> int {
    const double from_m = ground["from_m"][0], spacing_m = ground["spacing_m"];
    return ground["heights_mm"][static_cast<std::size_t>(std::lround((x_m - from_m) / spacing_m))];
  };
  EXPECT_EQ(height_mm(0.5), 0);
  EXPECT_EQ(height_mm(1.0), 50);
  EXPECT_EQ(height_mm(2.5), 200);
  EXPECT_EQ(height_mm(5.0), 0);
  metadata.command_line = "sprung up pegasus --sim --world mars";
  EXPECT_TRUE((*scene_of_log(read_robot_text(yaml, "log"), metadata).scene)["ground"].is_null());
  metadata.command_line = "sprung up pegasus --sim";
  EXPECT_TRUE((*scene_of_log(read_robot_text(yaml, "log"), metadata).scene)["ground"].is_null());
}

TEST(LoggedScene, HasThePatchesOfAWorldThatIsLevel) {
  const std::string yaml = log::robot_yaml("pegasus");
  sprung_msgs::log_metadata_t metadata = metadata_of(yaml);
  metadata.command_line = "sprung up pegasus --sim --plant world=ice --plant patch_friction=0.2";
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata);
  ASSERT_TRUE(found.scene);
  ASSERT_EQ((*found.scene)["ground"]["patches"].size(), 2u);
  EXPECT_EQ((*found.scene)["ground"]["patches"][0]["friction"], 0.2);
}

/// The installed robots are a copy in which this one's robot.yaml cannot be read.
class BrokenRobot {
 public:
  explicit BrokenRobot(const std::string& name) : folder_("robots") {
    const char* const before = std::getenv("SPRUNG_ROBOTS");
    if (before != nullptr) before_ = before;
    std::filesystem::copy(robot_folder(name), folder_ / name, std::filesystem::copy_options::recursive);
    std::ofstream(folder_ / (name + "/robot.yaml")) << "robot: " << name << "\nnonsense: 1\n";
    setenv("SPRUNG_ROBOTS", folder_.path().c_str(), 1);
  }
  ~BrokenRobot() { before_ ? setenv("SPRUNG_ROBOTS", before_->c_str(), 1) : unsetenv("SPRUNG_ROBOTS"); }

 private:
  test::OwnFolder folder_;
  std::optional<std::string> before_;
};

TEST(LoggedScene, IsThereWhereTheInstalledFileCannotBeRead) {
  const std::string yaml = log::robot_yaml("single_leg");
  const BrokenRobot installed("single_leg");
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml));
  EXPECT_TRUE(found.scene) << found.missing;
  EXPECT_THAT(found.note, HasSubstr("other lengths than this log's"));
}

TEST(LoggedScene, OfARobotWhoseJointsTheModelDoesNotHaveIsNone) {
  const std::string yaml = log::robot_yaml("single_leg", "knee", "shin");
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml));
  EXPECT_FALSE(found.scene);
  EXPECT_THAT(found.missing, HasSubstr("has no joint named shin"));
}

}  // namespace
}  // namespace sprung::station
