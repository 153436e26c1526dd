/// Which frames are shown: frame_filter.h, and which are repeats: repeat_filter.h.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "tools/can/decode/frame_filter.h"
#include "tools/can/decode/repeat_filter.h"

namespace sprung::cantools {
namespace {

class FrameFilterTest : public testing::Test {
 protected:
  bool shows(const std::vector<std::string>& texts, const CanFrame& frame) {
    const ObservedFrame observed{0, 0, Direction::kUnknown, frame};
    return FrameFilter(texts, description_).shows(observed, FrameDecoder(description_).decode(observed));
  }
  BusDescription description_ = describe_buses(load_robot("single_leg"));
  CanFrame sync_ = canopen::sync_frame();
  CanFrame heartbeat_ = canopen::heartbeat_frame(2, canopen::NmtState::kOperational);
  CanFrame request_ = canopen::sdo_read_request(1, {0x6041, 0});
};

TEST_F(FrameFilterTest, NothingAskedShowsAll) {
  EXPECT_TRUE(shows({}, sync_));
  EXPECT_TRUE(shows({}, heartbeat_));
}

TEST_F(FrameFilterTest, ByKindNodeAndIdentifier) {
  EXPECT_TRUE(shows({"sync"}, sync_));
  EXPECT_FALSE(shows({"sync"}, heartbeat_));
  EXPECT_TRUE(shows({"knee_motor"}, heartbeat_));
  EXPECT_FALSE(shows({"knee_motor"}, request_));
  EXPECT_TRUE(shows({"1"}, request_));
  EXPECT_TRUE(shows({"0x702"}, heartbeat_));
  EXPECT_FALSE(shows({"0x702"}, sync_));
}

TEST_F(FrameFilterTest, SeveralAddUp) {
  EXPECT_TRUE(shows({"sync", "sdo"}, request_));
  EXPECT_TRUE(shows({"sync", "sdo"}, sync_));
  EXPECT_FALSE(shows({"sync", "sdo"}, heartbeat_));
}

TEST_F(FrameFilterTest, ExclamationMarkLeavesOut) {
  EXPECT_FALSE(shows({"!sync"}, sync_));
  EXPECT_TRUE(shows({"!sync"}, heartbeat_));
  EXPECT_FALSE(shows({"knee_motor", "!heartbeat"}, heartbeat_));
}

TEST_F(FrameFilterTest, UnknownTextNamesWhatThereIs) {
  try {
    FrameFilter({"hip"}, description_);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("--filter hip"), testing::HasSubstr("hip_motor"),
                               testing::HasSubstr("heartbeat")));
  }
}

StampedFrame stamped(std::int64_t tick, int count, int index, const CanFrame& frame) {
  return {frame, encode_stamp({tick, count, index}), 0};
}

TEST(RepeatFilter, EveryNumberedFrameComesOnce) {
  RepeatFilter filter;
  const CanFrame sync = canopen::sync_frame();
  EXPECT_TRUE(filter.is_new(stamped(5, 2, 0, sync)));
  EXPECT_TRUE(filter.is_new(stamped(5, 2, 1, sync)));
  EXPECT_FALSE(filter.is_new(stamped(5, 2, 0, sync)));
  EXPECT_TRUE(filter.is_new(stamped(6, 2, 0, sync)));
  EXPECT_FALSE(filter.is_new(stamped(5, 2, 1, sync)));
}

TEST(RepeatFilter, MasterAndDrivesMayUseTheSameNumbers) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.is_new(stamped(5, 2, 0, canopen::sync_frame())));
  EXPECT_TRUE(filter.is_new(stamped(5, 2, 0, canopen::heartbeat_frame(1, canopen::NmtState::kOperational))));
}

TEST(RepeatFilter, MarksAreNoFramesAndPlainFramesAlwaysPass) {
  RepeatFilter filter;
  EXPECT_FALSE(filter.is_new(stamped(5, 1, 0, end_of_tick_mark())));
  EXPECT_TRUE(filter.is_new({canopen::sync_frame(), 0.0, 0}));
  EXPECT_TRUE(filter.is_new({canopen::sync_frame(), 0.0, 0}));
}

TEST(RepeatFilter, ANewRunOnTheSameAddressIsHeard) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.is_new(stamped(100'000, 1, 0, canopen::sync_frame())));
  EXPECT_TRUE(filter.is_new(stamped(3, 1, 0, canopen::sync_frame())));
  EXPECT_FALSE(filter.is_new(stamped(3, 1, 0, canopen::sync_frame())));
}

TEST(RepeatFilter, LateRepeatsOfLongAgoStayOut) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.is_new(stamped(100, 1, 0, canopen::sync_frame())));
  EXPECT_TRUE(filter.is_new(stamped(150, 1, 0, canopen::sync_frame())));
  EXPECT_FALSE(filter.is_new(stamped(100, 1, 0, canopen::sync_frame())));
}

}  // namespace
}  // namespace sprung::cantools
