#include "runtime/message_layout.h"

#include <gtest/gtest.h>

#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

using test::encoded;

TEST(MessageLayout, PredictsTheSizeForEveryCount) {
  const MessageLayout layout = layout_of<sprung_msgs::joint_state_t>();
  for (const std::size_t joints : {0U, 2U, 12U}) {
    for (const std::size_t legs : {0U, 1U, 4U}) {
      sprung_msgs::joint_state_t message{};
      message.n_joints = static_cast<std::int32_t>(joints);
      message.n_legs = static_cast<std::int32_t>(legs);
      message.joints.resize(joints);
      message.legs.resize(legs);
      EXPECT_EQ(encoded(message).size(),
                layout.fixed_size + joints * layout.element_size[0] + legs * layout.element_size[1]);
    }
  }
}

TEST(MessageLayout, LeavesStringsOutOfTheFixedSize) {
  const MessageLayout layout = layout_of<sprung_msgs::process_status_t>();
  sprung_msgs::process_status_t message{};
  message.robot = "abc";
  EXPECT_EQ(layout.strings, 8);
  EXPECT_EQ(encoded(message).size(), layout.fixed_size + 8 * 5 + 3);
}

TEST(MessageLayout, HeaderIsWhereItIsExpected) {
  sprung_msgs::joint_state_t message{};
  message.session = -0x0123456789ABCDEF;
  message.utime = 17;
  message.seq = 0x7766554433221100;
  message.n_joints = 3;
  message.n_legs = 1;
  message.joints.resize(3);
  message.legs.resize(1);
  const auto bytes = encoded(message);
  EXPECT_EQ(read_int64(bytes.data(), 0), layout_of<sprung_msgs::joint_state_t>().hash);
  EXPECT_EQ(read_int64(bytes.data(), kSessionOffset), message.session);
  EXPECT_EQ(read_int64(bytes.data(), kSeqOffset), message.seq);
  EXPECT_EQ(read_int32(bytes.data(), kCountsOffset), 3);
  EXPECT_EQ(read_int32(bytes.data(), kCountsOffset + 4), 1);
}

TEST(MessageLayout, NegativeNumbersAreRead) {
  const std::uint8_t bytes[8] = {0xFF, 0xFF, 0xFF, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF};
  EXPECT_EQ(read_int32(bytes, 0), -2);
  EXPECT_EQ(read_int64(bytes, 0), -1LL - 0x100000000LL);
}

TEST(CountLimits, HugeCountsAreLimitedToTheirType) {
  EXPECT_EQ(CountLimits::up_to(std::size_t{1} << 40U).most[0], std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(CountLimits::exactly(2, 1).least[1], 1);
}

}  // namespace
}  // namespace sprung
