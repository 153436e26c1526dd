#include "drivers/imu/mtdata2.h"

#include <gtest/gtest.h>

#include "tests/drivers/imu/xbus_bytes.h"

namespace sprung::imu {
namespace {

using test::Bytes;

bool decodes(const Bytes& bytes, MtData2& out) { return decode_mtdata2(bytes.data(), bytes.size(), out); }

TEST(MtData2Test, ReadsEveryPacketThatIsUsed) {
  test::XbusSample sample;
  sample.counter = 0x1234;
  sample.quaternion = {0.5F, -0.5F, 0.5F, -0.5F};
  MtData2 out;
  ASSERT_TRUE(decodes(sample.data(), out));
  EXPECT_TRUE(out.has_counter && out.has_time && out.has_rate && out.has_force && out.has_quaternion &&
              out.has_status);
  EXPECT_EQ(out.counter, 0x1234);
  EXPECT_EQ(out.time_100us, 20U * 0x1234);
  EXPECT_FLOAT_EQ(static_cast<float>(out.rate_rad_s[2]), 0.3F);
  EXPECT_FLOAT_EQ(static_cast<float>(out.force_m_s2[2]), 9.81F);
  EXPECT_DOUBLE_EQ(out.quaternion_wxyz[3], -0.5);
  EXPECT_EQ(out.status, 3U);
  EXPECT_FALSE(out.world_is_down);
}

// Bytes of one packet typed by hand: 1.0, -2.0 and 0.5 in each format.
TEST(MtData2Test, ReadsEveryFormatOfNumbers) {
  const Bytes formats[] = {{0x80, 0x20, 12, 0x3F, 0x80, 0, 0, 0xC0, 0, 0, 0, 0x3F, 0, 0, 0},
                           {0x80, 0x21, 12, 0, 0x10, 0, 0, 0xFF, 0xE0, 0, 0, 0, 0x08, 0, 0},
                           {0x80, 0x22, 18, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0xFF, 0xFE, 0x80, 0, 0, 0, 0, 0},
                           {0x80, 0x23, 24, 0x3F, 0xF0, 0,    0,    0, 0, 0, 0, 0xC0, 0, 0,
                            0,    0,    0,  0,    0,    0x3F, 0xE0, 0, 0, 0, 0, 0,    0}};
  for (const Bytes& bytes : formats) {
    MtData2 out;
    ASSERT_TRUE(decodes(bytes, out)) << static_cast<int>(bytes[1]);
    EXPECT_EQ(out.rate_rad_s, (std::array<double, 3>{1.0, -2.0, 0.5})) << static_cast<int>(bytes[1]);
  }
}

TEST(MtData2Test, SaysWhichWayTheWorldPoints) {
  for (const int axes : {0x0, 0x4, 0x8}) {
    test::XbusSample sample;
    sample.quaternion_id = static_cast<std::uint16_t>(0x2010 | axes);
    MtData2 out;
    ASSERT_TRUE(decodes(sample.data(), out));
    EXPECT_EQ(out.world_is_down, axes == 0x4);
  }
}

TEST(MtData2Test, SkipsWhatItDoesNotKnow) {
  Bytes bytes = test::floats(0xC020, {1.0F, 2.0F, 3.0F});  // magnetic field
  test::append(bytes, test::floats(0x8020, {1.0F, 2.0F, 3.0F}));
  MtData2 out;
  ASSERT_TRUE(decodes(bytes, out));
  EXPECT_TRUE(out.has_rate);
}

TEST(MtData2Test, NothingIsNoData) {
  MtData2 out;
  EXPECT_TRUE(decodes({}, out));
  EXPECT_FALSE(out.has_rate || out.has_counter);
}

TEST(MtData2Test, PacketsThatDoNotFitAreRefused) {
  const Bytes good = test::XbusSample().data();
  MtData2 out;
  std::size_t taken = 0;
  for (std::size_t size = 1; size < good.size(); ++size)
    taken += decodes({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}, out) ? 1 : 0;
  EXPECT_EQ(taken, 5U) << "only where one packet ends and another begins";
  EXPECT_FALSE(decodes(test::floats(0x8020, {1.0F, 2.0F}), out)) << "two of three";
  EXPECT_FALSE(decodes(test::packet(0x1020, {1, 2, 3}), out));
}

}  // namespace
}  // namespace sprung::imu
