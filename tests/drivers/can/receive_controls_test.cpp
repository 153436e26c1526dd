#include "drivers/can/receive_controls.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace sprung {
namespace {

/// What the kernel would put beside a frame.
class Controls {
 public:
  Controls() {
    header_.msg_control = bytes_.data();
    header_.msg_controllen = bytes_.size();
    next_ = CMSG_FIRSTHDR(&header_);
  }
  template <class Value>
  void add(int type, const Value& value) {
    next_->cmsg_level = SOL_SOCKET;
    next_->cmsg_type = type;
    next_->cmsg_len = CMSG_LEN(sizeof value);
    std::memcpy(CMSG_DATA(next_), &value, sizeof value);
    next_ = CMSG_NXTHDR(&header_, next_);
  }
  msghdr& header() { return header_; }

 private:
  alignas(cmsghdr) std::array<char, kReceiveControl_bytes> bytes_{};
  msghdr header_{};
  cmsghdr* next_ = nullptr;
};

TEST(ReceiveControls, StampIsTurnedIntoMonotonicMicroseconds) {
  Controls controls;
  controls.add(SCM_TIMESTAMPNS, timespec{1'700'000'000, 123'456'789});
  KernelDrops drops;
  EXPECT_EQ(read_receive_controls(controls.header(), 1'699'999'000'000'000, drops), 1'000'123'456);
  EXPECT_EQ(drops.total, 0);
}

TEST(ReceiveControls, WithoutAStampArrivalIsZero) {
  Controls controls;
  controls.add(SO_RXQ_OVFL, std::uint32_t{5});
  KernelDrops drops;
  EXPECT_EQ(read_receive_controls(controls.header(), 1000, drops), 0);
  EXPECT_EQ(drops.total, 5);
}

TEST(ReceiveControls, DropsAddUpOverTheKernelsWrap) {
  KernelDrops drops;
  for (const std::uint32_t counter : {0xFFFFFFFEu, 0xFFFFFFFEu, 3u}) {
    Controls controls;
    controls.add(SO_RXQ_OVFL, counter);
    read_receive_controls(controls.header(), 0, drops);
  }
  EXPECT_EQ(drops.total, 0xFFFFFFFEll + 5);
}

TEST(UtcOffset, TakesUtcToMonotonic) {
  UtcOffset offset;
  offset.update(1000, 5'001'001, 1002);
  EXPECT_EQ(offset.us(), 5'000'000);
}

TEST(UtcOffset, InterruptedReadingChangesNothing) {
  UtcOffset offset;
  offset.update(1000, 5'001'000, 1000);
  offset.update(2000, 5'002'001, 9000);
  EXPECT_EQ(offset.us(), 5'000'000);
}

TEST(UtcOffset, StepOfTheWallClockIsFollowed) {
  UtcOffset offset;
  offset.update(1000, 5'001'000, 1000);
  offset.update(2000, 9'002'000, 2000);
  EXPECT_EQ(offset.us(), 9'000'000);
  offset.update(3000, 9'002'990, 3000);
  EXPECT_EQ(offset.us(), 8'999'990);
}

TEST(UtcOffset, BadFirstReadingIsMended) {
  UtcOffset offset;
  offset.update(1000, 5'001'000, 9000);
  offset.update(20'000, 5'020'000, 20'000);
  EXPECT_EQ(offset.us(), 5'000'000);
}

TEST(UtcOffset, ReadsTheClocks) {
  timespec utc{};
  clock_gettime(CLOCK_REALTIME, &utc);
  UtcOffset offset;
  offset.update();
  const std::int64_t converted_us = utc.tv_sec * 1'000'000 + utc.tv_nsec / 1000 - offset.us();
  EXPECT_NEAR(static_cast<double>(converted_us), static_cast<double>(can_clock_us()), 5e6)
      << "seconds, not decades, apart";
}

}  // namespace
}  // namespace sprung
