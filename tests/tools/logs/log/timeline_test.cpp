#include "tools/logs/log/timeline.h"

#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class LogTimeline : public testing::Test {
 protected:
  Timeline::Moment moment(const Kept& kept) {
    Event event;
    event.time_us = kept.time_us;
    event.channel = kept.channel;
    event.data = reinterpret_cast<const std::uint8_t*>(kept.data.data());
    event.size = kept.data.size();
    return timeline_.next(event);
  }
  Timeline timeline_;
};

TEST_F(LogTimeline, CyclesCountByTheirStampsHoweverTheyWereReceived) {
  Kept first = joint_event(10), second = joint_event(20);
  second.time_us = first.time_us + 999'999;
  EXPECT_EQ(moment(first).time_s, 0.0);
  EXPECT_DOUBLE_EQ(moment(second).time_s, 10 * 0.002);
  EXPECT_EQ(timeline_.begin_us(), first.time_us);
}

TEST_F(LogTimeline, OthersCountFromTheNewestCycleByWhenTheyWereReceived) {
  moment(joint_event(0));
  Kept late = joint_event(1);
  late.time_us += 50'000;
  moment(late);
  Kept camera{0, late.time_us + 700, "CAMERA", "picture"};
  EXPECT_NEAR(moment(camera).time_s, 0.002 + 0.0007, 1e-9);
}

TEST_F(LogTimeline, ALogWithoutCyclesCountsAsReceived) {
  moment({0, 1'000'000, "CAMERA", "a"});
  EXPECT_NEAR(moment({0, 1'250'000, "CAMERA", "b"}).time_s, 0.25, 1e-9);
}

TEST_F(LogTimeline, AnotherSessionGoesOnWhereItWasReceived) {
  moment(joint_event(0));
  Kept next = joint_event(0, 88);
  next.time_us += 3'000'000;
  EXPECT_NEAR(moment(next).time_s, 3.0, 1e-9);
  Kept after = joint_event(5, 88);
  after.time_us = next.time_us + 1;
  EXPECT_NEAR(moment(after).time_s, 3.0 + 5 * 0.002, 1e-9);
}

TEST_F(LogTimeline, MetadataBeginsNothing) {
  EXPECT_EQ(moment(metadata_event()).time_s, 0.0);
  EXPECT_EQ(moment(joint_event(3)).time_s, 0.0);
  EXPECT_EQ(timeline_.begin_us(), joint_event(3).time_us);
}

TEST_F(LogTimeline, StampsAreThoseOfTheMessage) {
  const auto found = moment(joint_event(7)).stamp;
  ASSERT_TRUE(found);
  EXPECT_EQ(found->session, 77);
  EXPECT_EQ(found->seq, 7);
  EXPECT_EQ(found->utime_us, 5'000'000 + 7 * 2000);
  EXPECT_FALSE(moment({0, 1, "CAMERA", std::string(64, 'x')}).stamp);
  EXPECT_FALSE(moment({0, 1, "JOINT_STATE", joint_event(7).data.substr(0, 31)}).stamp);
}

TEST_F(LogTimeline, NumbersOfADamagedMessageDoNoHarm) {
  moment(joint_event(0));
  auto wild = stamped<sprung_msgs::joint_state_t>(1);
  wild.utime = std::numeric_limits<std::int64_t>::min();
  wild.seq = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(std::isfinite(
      moment({0, std::numeric_limits<std::int64_t>::max(), "JOINT_STATE", encoded(wild)}).time_s));
  EXPECT_NEAR(moment(joint_event(2)).time_s, 2 * 0.002, 1e-9);
}

}  // namespace
}  // namespace sprung::log
