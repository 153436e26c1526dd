/// What the messages hold is checked by Foxglove's own reader: tests/conformance/test_mcap.py.
#include "tools/station/foxglove/robot_topics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "tests/tools/logs/log/robot_sample.h"
#include "tools/station/foxglove/foxglove_messages.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {
namespace {

using log::Kept;

class RobotTopicsTest : public testing::Test {
 protected:
  RobotTopicsTest() { topics_->begin(writer_); }
  std::vector<log::McapAddition> add(const Kept& kept, double time_s) {
    log::Event event;
    event.channel = kept.channel;
    event.data = reinterpret_cast<const std::uint8_t*>(kept.data.data());
    event.size = kept.data.size();
    return topics_->add(event, time_s, log::kSampleBegin_us);
  }

  std::string file_;
  log::McapWriter writer_{[this](std::string_view bytes) { file_ += bytes; }, "test"};
  RobotConfig robot_ = load_robot("single_leg");
  std::unique_ptr<log::McapAdditions> topics_ = make_robot_topics(robot_, make_scene(robot_), "<mujoco/>");
};

TEST_F(RobotTopicsTest, AreSixAndTheModelIsAttached) {
  writer_.finish();
  for (const char* topic :
       {"/tf", "/robot", "/forces", "/joint_states", "/wrenches", "/imu", "model.xml", "<mujoco/>"})
    EXPECT_NE(file_.find(topic), std::string::npos) << topic;
}

TEST_F(RobotTopicsTest, ComeAtMostAHundredTimesASecondAndShapesOnce) {
  std::size_t messages = 0;
  for (int k = 0; k < 1000; ++k) messages += add(log::joint_event(k), 0.001 * k).size();
  messages += topics_->finish().size();
  EXPECT_GE(messages, 1 + 3 * 90u) << "nobody tells of an IMU or of ground under the foot";
  EXPECT_LE(messages, 1 + 3 * 101u);
}

TEST_F(RobotTopicsTest, OfJointStatesOfAnotherVersionAreEmptyAndSayWhy) {
  for (int k = 0; k < 20; ++k) {
    Kept other = log::joint_event(k);
    other.data[0] ^= 0x55;
    EXPECT_TRUE(add(log::command_event(k, k), 0.01 * k).empty());
    EXPECT_TRUE(add(other, 0.01 * k).empty());
  }
  EXPECT_TRUE(topics_->finish().empty()) << "a robot at rest would be a false picture";
  EXPECT_THAT(topics_->notes("0.9 (abc)"),
              testing::Contains(testing::HasSubstr("JOINT_STATE is of another version of its message")));
}

TEST_F(RobotTopicsTest, AreStampedWithTheRobotsTime) {
  add(log::joint_event(0), 0.25);
  const auto messages = topics_->finish();
  ASSERT_FALSE(messages.empty());
  EXPECT_EQ(messages[0].head.log_ns, static_cast<std::uint64_t>(log::kSampleBegin_us + 250'000) * 1000);
}

TEST(FoxgloveMessages, HaveDefinitionsOfTheirMakers) {
  for (const char* name : {"foxglove.FrameTransforms", "foxglove.SceneUpdate", "foxglove.JointStates",
                           "sprung.Wrenches", "sprung.Imu"})
    EXPECT_NE(foxglove_schema(name).find("foxglove/"), std::string::npos) << name;
  EXPECT_EQ(foxglove_schema("foxglove.Nothing"), "");
}

TEST(FoxgloveMessages, AnArrowWithoutLengthIsNone) {
  FoxgloveEntity entity("world", "a", false, 1);
  const std::string before = entity.bytes();
  entity.add_arrow({0, 0, 0}, {0, 0, 0}, 0.01, {1, 1, 1, 1});
  EXPECT_EQ(entity.bytes(), before);
  entity.add_arrow({0, 0, 0}, {0, 0, 1}, 0.01, {1, 1, 1, 1});
  EXPECT_GT(entity.bytes().size(), before.size());
}

}  // namespace
}  // namespace sprung::station
