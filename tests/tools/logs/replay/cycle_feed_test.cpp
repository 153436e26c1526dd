#include "tools/logs/replay/cycle_feed.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "estimator/estimator_core.h"
#include "lcmtypes/channels.h"
#include "tests/tools/logs/replay/logged_message.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/logs/log/writer.h"

namespace sprung {
namespace {

using test::message_of;

constexpr double kAll_s = std::numeric_limits<double>::infinity();
constexpr std::int64_t kCycleFeedCycles = 2000;  // more than all batches hold

class CycleFeedTest : public testing::Test {
 protected:
  DriveState drives(std::int64_t seq) const {
    DriveState out(robot_.actuators.size());
    out.stamp = {1000 * seq, seq};
    for (std::size_t i = 0; i < out.actuators.size(); ++i)
      out.actuators[i].measured_position_rad = 1e-4 * static_cast<double>(seq) + static_cast<double>(i);
    return out;
  }
  /// @param damaged cycle whose DRIVE_STATE is of another type; -1: none.
  std::string log(std::int64_t damaged = -1, int others_a_cycle = 0) const {
    const std::string path = folder_ / "log.lcm";
    log::Writer writer(path);
    JointState joints(robot_.joints.size(), robot_.legs.size());
    for (std::int64_t k = 0; k < kCycleFeedCycles; ++k) {
      joints.stamp = {1000 * k, k};
      Bytes in = message_of(drives(k));
      if (k == damaged) in[0] ^= 0xFF;
      const auto write = [&](const char* channel, const Bytes& bytes) {
        writer.write(1'000'000 + 1000 * k, channel, bytes.data(), bytes.size());
      };
      write(channels::kDriveState, in);
      write(channels::kJointState, message_of(joints));
      for (int i = 0; i < others_a_cycle; ++i) write("OTHER", {1, 2, 3});
    }
    writer.close();
    return path;
  }

  const RobotConfig robot_ = load_robot("single_leg");
  EstimatorReplay estimator_{robot_, "best", robot_.watchdogs, true};
  const test::Folder folder_{"cycle-feed"};
};

TEST_F(CycleFeedTest, EveryCycleComesOnceInOrderWithWhatTheEstimatorMakesOfIt) {
  EstimatorCore alone(as_in_preset(robot_, "best"));
  JointState expected(robot_.joints.size(), robot_.legs.size());
  CycleFeed feed(log(), kAll_s, robot_, estimator_);
  std::int64_t next = 0;
  while (CycleBatch* const batch = feed.next()) {
    for (std::size_t i = 0; i < batch->count; ++i, ++next) {
      const auto& [logged, estimated] = batch->cycles[i];
      ASSERT_EQ(logged.seq, next);
      ASSERT_EQ(logged.drive_state, message_of(drives(next)));
      alone.step(drives(next), expected);
      ASSERT_TRUE(estimated.made);
      ASSERT_EQ(message_of(estimated.joint_state), message_of(expected)) << next;
    }
  }
  EXPECT_EQ(next, kCycleFeedCycles);
  EXPECT_EQ(feed.flaws().late, 0);
  EXPECT_EQ(feed.damage_count(), 0u);
  EXPECT_EQ(feed.next(), nullptr);
}

TEST_F(CycleFeedTest, WhatTheCallerTakesOutOfACycleDoesNotComeAgain) {
  CycleFeed feed(log(), kAll_s, robot_, estimator_);
  std::int64_t next = 0;
  while (CycleBatch* const batch = feed.next()) {
    for (std::size_t i = 0; i < batch->count; ++i, ++next) {
      auto& [logged, estimated] = batch->cycles[i];
      ASSERT_EQ(logged.seq, next);
      ASSERT_TRUE(logged.replies.empty());
      logged.replies.push_back({1});
      estimated.joint_state = JointState(robot_.joints.size(), robot_.legs.size());
    }
  }
  EXPECT_EQ(next, kCycleFeedCycles);
}

TEST_F(CycleFeedTest, LaterCyclesAreLeftOut) {
  CycleFeed feed(log(), 0.7, robot_, estimator_);
  std::int64_t last = -1;
  while (const CycleBatch* const batch = feed.next()) {
    if (batch->count > 0) last = batch->cycles[batch->count - 1].logged.seq;
  }
  EXPECT_EQ(last, 700);
}

TEST_F(CycleFeedTest, ErrorComesAfterAllCyclesBeforeIt) {
  for (const std::int64_t damaged : {0, 31, 32, 33, 64, 1500}) {
    EstimatorReplay estimator(robot_, "best", robot_.watchdogs, true);
    CycleFeed feed(log(damaged), kAll_s, robot_, estimator);
    std::int64_t seen = 0;
    try {
      while (const CycleBatch* const batch = feed.next()) seen += static_cast<std::int64_t>(batch->count);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("DRIVE_STATE"), std::string::npos);
    }
    EXPECT_EQ(seen, damaged);
  }
}

TEST_F(CycleFeedTest, ThreadEndsWhereTheCallerDoesNotReadOn) {
  const std::string path = log();
  for (int batches = 0; batches < 4; ++batches) {
    CycleFeed feed(path, kAll_s, robot_, estimator_);
    for (int i = 0; i < batches; ++i) EXPECT_NE(feed.next(), nullptr);
  }
}

TEST_F(CycleFeedTest, PositionComesNowAndThenAlsoWithoutCycles) {
  CycleFeed feed(log(-1, 48), -1.0, robot_, estimator_);  // 100,000 events, and no cycle in time
  std::vector<std::uint64_t> positions;
  while (const CycleBatch* const batch = feed.next()) {
    EXPECT_EQ(batch->count, 0u);
    if (batch->position) positions.push_back(*batch->position);
  }
  ASSERT_EQ(positions.size(), 5u);
  EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
  EXPECT_GT(positions.front(), 0u);
  EXPECT_LE(positions.back(), feed.file_bytes());
}

TEST_F(CycleFeedTest, DamageOfTheFileIsCounted) {
  const std::string path = log();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10);
  CycleFeed feed(path, kAll_s, robot_, estimator_);
  std::int64_t seen = 0;
  while (const CycleBatch* const batch = feed.next()) seen += static_cast<std::int64_t>(batch->count);
  EXPECT_EQ(seen, kCycleFeedCycles);
  EXPECT_EQ(feed.damage_count(), 1u);
}

TEST_F(CycleFeedTest, FileThatIsNotThereIsNamed) {
  const std::string path = folder_ / "none.lcm";
  try {
    CycleFeed feed(path, kAll_s, robot_, estimator_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung
