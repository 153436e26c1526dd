#include "tools/logs/recorder/log_messages.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "robots/robot_loader.h"
#include "tools/logs/recorder/log_metadata.h"

namespace sprung {
namespace {

sprung_msgs::log_metadata_t sample() {
  return make_log_metadata(load_robot("single_leg"),
                           {"paper", "lockstep", true, 42, 1'000, 2'000, "sprung up single_leg", "udpm://x"});
}

TEST(LogMetadata, HoldsTheWholeRobotFile) {
  const sprung_msgs::log_metadata_t metadata = sample();
  std::ifstream file(load_robot("single_leg").folder + "/robot.yaml");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_GT(text.size(), 1000u);
  EXPECT_EQ(metadata.robot_yaml, text);
}

TEST(LogMetadata, SaysWhatRan) {
  const sprung_msgs::log_metadata_t metadata = sample();
  EXPECT_EQ(metadata.robot, "single_leg");
  EXPECT_EQ(metadata.preset, "paper");
  EXPECT_EQ(metadata.clock, "lockstep");
  EXPECT_EQ(metadata.simulation, 1);
  EXPECT_EQ(metadata.session, 42);
  EXPECT_EQ(metadata.seq, -1);
  EXPECT_FALSE(metadata.git_hash.empty());
  EXPECT_FALSE(metadata.version.empty());
  EXPECT_FALSE(metadata.host.empty());
}

TEST(LogMetadata, FitsIntoOneDatagram) {
  for (const char* robot : {"single_leg", "pegasus"}) {
    const auto metadata = make_log_metadata(load_robot(robot), {"best", "realtime", false, 1, 0, 0, "", ""});
    EXPECT_LT(message_bytes(metadata).size(), 64'000u) << robot;
  }
}

TEST(LogMetadata, RobotWithoutItsFileIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.folder = "/nowhere";
  EXPECT_THROW((void)make_log_metadata(robot, {}), std::runtime_error);
}

TEST(LogMessages, AreReadAsTheyWereWritten) {
  const auto bytes = message_bytes(sample());
  const auto back = read_log_metadata(bytes.data(), bytes.size());
  ASSERT_TRUE(back);
  EXPECT_EQ(message_bytes(*back), bytes);
  sprung_msgs::log_end_t end{};
  end.events = 17;
  end.reason = static_cast<std::int8_t>(LogEndReason::kDiskGuard);
  end.detail = "full";
  const auto end_bytes = message_bytes(end);
  const auto end_back = read_log_end(end_bytes.data(), end_bytes.size());
  ASSERT_TRUE(end_back);
  EXPECT_EQ(end_back->events, 17);
  EXPECT_EQ(end_back->detail, "full");
}

TEST(LogMessages, OneIsNotTakenForTheOther) {
  const auto bytes = message_bytes(sample());
  EXPECT_FALSE(read_log_end(bytes.data(), bytes.size()));
}

/// Any length, any byte changed: refused or read, never past the end.
TEST(LogMessages, DamagedBytesAreRefused) {
  const auto good = message_bytes(sample());
  for (std::size_t size = 0; size < 200; ++size) EXPECT_FALSE(read_log_metadata(good.data(), size));
  EXPECT_FALSE(read_log_metadata(good.data(), good.size() - 1));
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    auto bytes = good;
    bytes[random() % 256] ^= static_cast<std::uint8_t>(1 + random() % 255);
    const auto message = read_log_metadata(bytes.data(), bytes.size());
    if (message) {
      EXPECT_EQ(message_bytes(*message).size(), bytes.size());
    }
  }
}

}  // namespace
}  // namespace sprung
