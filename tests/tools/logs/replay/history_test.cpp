#include "tools/logs/replay/history.h"

#include <gtest/gtest.h>

#include "signals/sensors.h"

namespace sprung {
namespace {

Imu imu(std::int64_t seq, std::int64_t utime_us = 0) {
  Imu out;
  out.stamp = {utime_us, seq};
  return out;
}

TEST(History, FindsWhatWasKept) {
  History<Imu> history{Imu()};
  EXPECT_EQ(history.find(0), nullptr);
  history.keep(imu(7, 42));
  ASSERT_NE(history.find(7), nullptr);
  EXPECT_EQ(history.find(7)->stamp.utime_us, 42);
  EXPECT_EQ(history.find(6), nullptr);
  EXPECT_EQ(history.find(-1), nullptr);
}

TEST(History, ForgetsWhatIsTooOld) {
  History<Imu> history{Imu()};
  history.keep(imu(3));
  history.keep(imu(3 + History<Imu>::kDepth));
  EXPECT_EQ(history.find(3), nullptr);
  EXPECT_NE(history.find(3 + History<Imu>::kDepth), nullptr);
}

TEST(History, NewestAtOrBefore) {
  History<Imu> history{Imu()};
  history.keep(imu(10));
  history.keep(imu(12));
  EXPECT_EQ(history.newest_at_or_before(9), nullptr);
  EXPECT_EQ(history.newest_at_or_before(11)->stamp.seq, 10);
  EXPECT_EQ(history.newest_at_or_before(12)->stamp.seq, 12);
  EXPECT_EQ(history.newest_at_or_before(100)->stamp.seq, 12);
  EXPECT_EQ(history.newest_at_or_before(12 + History<Imu>::kDepth), nullptr);
}

TEST(History, IsEmptyAfterClear) {
  History<Imu> history{Imu()};
  history.keep(imu(0));
  history.clear();
  EXPECT_EQ(history.find(0), nullptr);
}

}  // namespace
}  // namespace sprung
