#include "tools/logs/replay/log_diff.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "lcmtypes/channels.h"
#include "tests/tools/logs/replay/logged_message.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/logs/log/writer.h"

namespace sprung {
namespace {

using test::Folder;
using test::message_of;

/// Two logs of one IMU, cycle by cycle.
class LogDiff : public testing::Test {
 protected:
  void imu(log::Writer& writer, std::int64_t seq, double rate_rad_s = 0.0, std::int64_t late_us = 0) {
    Imu imu;
    imu.stamp = {1000 * seq + late_us, seq};
    imu.measured_angular_velocity_rad_s = {rate_rad_s, 0.0, 0.0};
    const Bytes bytes = message_of(imu, &writer == &first_ ? 1 : 2);
    writer.write(1'000'000 + 1000 * seq, channels::kImu, bytes.data(), bytes.size());
  }
  void safety(log::Writer& writer, std::int64_t seq) {
    SafetyState state;
    state.stamp = {1000 * seq, seq};
    const Bytes bytes = message_of(state);
    writer.write(1'000'000 + 1000 * seq, channels::kSafetyState, bytes.data(), bytes.size());
  }
  DiffResult diff(const std::vector<std::string>& channels = {}) {
    first_.flush();
    second_.flush();
    DiffRequest request;
    request.first = folder_ / "a.lcm";
    request.second = folder_ / "b.lcm";
    request.channels = channels;
    request.courses = true;
    return diff_logs(request);
  }

  const Folder folder_{"log-diff"};
  log::Writer first_{folder_ / "a.lcm"};
  log::Writer second_{folder_ / "b.lcm"};
};

TEST_F(LogDiff, SameMessagesOfTwoSessionsAreIdentical) {
  for (int k = 0; k < 100; ++k) imu(first_, k), imu(second_, k);
  const DiffResult result = diff();
  EXPECT_TRUE(result.identical());
  EXPECT_EQ(result.channels.at("IMU").in_both, 100);
}

TEST_F(LogDiff, WhatHasNoLikeIsNotHeldToTheEnd) {
  for (int k = 0; k < 20'000; ++k) {
    imu(first_, k);
    if (k % 10 == 0) imu(second_, k);
  }
  const DiffResult overlapping = diff();
  EXPECT_EQ(overlapping.channels.at("IMU").in_both, 2000);
  EXPECT_EQ(overlapping.channels.at("IMU").only_first, 18'000);
  EXPECT_LT(overlapping.most_waiting, 1100u);
}

TEST_F(LogDiff, RestOfALongerLogIsCountedAndNotHeld) {
  for (int k = 0; k < 5000; ++k) imu(first_, k);
  imu(second_, 0);
  const DiffResult longer = diff();
  EXPECT_EQ(longer.channels.at("IMU").only_first, 4999);
  EXPECT_LT(longer.most_waiting, 3u);
}

TEST_F(LogDiff, EmptyLogsAreNotCalledIdentical) { EXPECT_FALSE(diff().identical()); }

TEST_F(LogDiff, FirstDifferenceAndItsCourse) {
  for (int k = 0; k < 100; ++k) imu(first_, k), imu(second_, k, k < 40 ? 0.0 : 0.01 * k);
  const DiffResult result = diff();
  EXPECT_FALSE(result.identical());
  EXPECT_EQ(result.channels.at("IMU").differing, 60);
  ASSERT_TRUE(result.differences.first());
  EXPECT_EQ(result.differences.first()->seq, 40);
  const FieldCourse& course = result.differences.fields().at({"IMU", "measured_angular_velocity_rad_s[0]"});
  EXPECT_EQ(course.count, 60);
  EXPECT_NEAR(course.largest, 0.99, 1e-12);
  EXPECT_EQ(course.time_s.size(), 60u);
}

TEST_F(LogDiff, CyclesBelongTogetherHoweverManyAreMissing) {
  for (int k = 0; k < 100; ++k) {
    if (k % 10 != 3) imu(first_, k, 0.1 * k);
    if (k % 10 != 7) imu(second_, k, 0.1 * k);
  }
  const DiffResult result = diff();
  const ChannelDiff& counts = result.channels.at("IMU");
  EXPECT_EQ(counts.in_both, 80);
  EXPECT_EQ(counts.differing, 0);
  EXPECT_EQ(counts.only_first, 10);
  EXPECT_EQ(counts.only_second, 10);
  EXPECT_FALSE(result.identical());
}

TEST_F(LogDiff, RepeatsOfLockStepCountOnce) {
  for (int k = 0; k < 10; ++k) imu(first_, k), imu(second_, k);
  imu(second_, 9);
  imu(second_, 8);
  EXPECT_TRUE(diff().identical());
}

TEST_F(LogDiff, TimesOfTwoRunsMayDiffer) {
  for (int k = 0; k < 10; ++k) imu(first_, k), imu(second_, k, 0.0, 37);
  EXPECT_TRUE(diff().identical());
}

TEST_F(LogDiff, ChannelsWithoutCyclesAreComparedInTheirOrderWhereAsked) {
  imu(first_, 0), imu(second_, 0);
  safety(first_, 3), safety(second_, 5);
  EXPECT_TRUE(diff().identical());
  const DiffResult asked = diff({"SAFETY_STATE"});
  EXPECT_EQ(asked.channels.at("SAFETY_STATE").differing, 1);
  ASSERT_TRUE(asked.differences.first());
  EXPECT_EQ(asked.differences.first()->field.path, "seq");
}

TEST_F(LogDiff, OnlyTheSpanIsCompared) {
  for (int k = 0; k < 100; ++k) imu(first_, k), imu(second_, k, k < 40 ? 0.0 : 1.0);
  first_.flush();
  second_.flush();
  DiffRequest request{folder_ / "a.lcm", folder_ / "b.lcm", {}, 0.0, 0.0395, false};
  EXPECT_TRUE(diff_logs(request).identical());
}

/// Lock-step and one process, or two runs of one seed: what design section 4 promises.
TEST(LogDiffOfRuns, SameSeedIsIdenticalAndAnotherIsNot) {
  const Folder folder("log-diff-runs");
  {
    const test::LogsOf logs(folder.path().string());
    RunScript script = test::jump_script_of(load_robot("single_leg"), 300);
    test::run(script);
    test::run(script);
    script.sim.seed = 4;
    test::run(script);
  }
  DiffRequest request;
  request.first = folder / "single_leg-000.lcm";
  request.second = folder / "single_leg-001.lcm";
  const DiffResult same = diff_logs(request);
  EXPECT_TRUE(same.identical());
  EXPECT_TRUE(same.metadata.empty());
  EXPECT_EQ(same.channels.size(),
            6u);  // DRIVE_STATE, JOINT_STATE, DRIVE_COMMAND, LEG_COMMAND, MOTION_STATE, SIM_TRUTH
  request.second = folder / "single_leg-002.lcm";
  EXPECT_FALSE(diff_logs(request).identical());
}

}  // namespace
}  // namespace sprung
