#include "tools/station/scene/logged_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
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

TEST(LoggedScene, OfARobotWhoseJointsTheModelDoesNotHaveIsNone) {
  const std::string yaml = log::robot_yaml("single_leg", "knee", "shin");
  const LoggedScene found = scene_of_log(read_robot_text(yaml, "log"), metadata_of(yaml));
  EXPECT_FALSE(found.scene);
  EXPECT_THAT(found.missing, HasSubstr("has no joint named shin"));
}

}  // namespace
}  // namespace sprung::station
