#include "tools/logs/fields/decoder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sprung_msgs/bus_state_t.hpp"
#include "sprung_msgs/can_trace_t.hpp"
#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "tests/signals/message_bytes.h"
#include "tests/support/enumerators.h"

namespace sprung::fields {
namespace {

using test::encoded;

sprung_msgs::joint_state_t joint_state(std::size_t joints, std::size_t legs) {
  sprung_msgs::joint_state_t message{};
  message.session = 77;
  message.utime = 123456;
  message.seq = 42;
  message.n_joints = static_cast<std::int32_t>(joints);
  message.n_legs = static_cast<std::int32_t>(legs);
  message.joints.resize(joints);
  message.legs.resize(legs);
  return message;
}

sprung_msgs::motion_state_t motion_state() {
  sprung_msgs::motion_state_t message{};
  message.n_legs = 1;
  message.legs.resize(1);
  return message;
}

class DecoderTest : public testing::Test {
 protected:
  template <class M>
  Fault open(const M& message) {
    bytes_ = encoded(message);
    return decoder_.open(bytes_.data(), bytes_.size(), view_);
  }
  const Field& field(const std::string& path) {
    const int index = view_.layout()->find(path);
    if (index < 0) throw std::runtime_error("no field " + path);
    return view_.fields()[index];
  }
  double number(const std::string& path) { return view_.number(field(path)); }

  Decoder decoder_;
  MessageView view_;
  std::vector<std::uint8_t> bytes_;
};

TEST(Faults, EveryOneHasItsOwnName) { test::expect_own_names<Fault>(); }

TEST_F(DecoderTest, GivesNumbersOfEveryElement) {
  auto message = joint_state(3, 2);
  message.joints[2].gear_output_torque_Nm = -12.5;
  message.joints[0].estimated_position_rad = std::nan("");
  message.joints[1].identified = 1;
  message.legs[1].foot_force_N[2] = 130.25;
  message.safety = -3;
  message.body.estimated_quaternion_wxyz[3] = 0.5;
  ASSERT_EQ(open(message), Fault::kNone);
  EXPECT_EQ(number("joints[2].gear_output_torque_Nm"), -12.5);
  EXPECT_TRUE(std::isnan(number("joints[0].estimated_position_rad")));
  EXPECT_EQ(number("joints[1].identified"), 1.0);
  EXPECT_EQ(number("legs[1].foot_force_N[2]"), 130.25);
  EXPECT_EQ(view_.integer(field("safety")), -3);
  EXPECT_EQ(number("body.estimated_quaternion_wxyz[3]"), 0.5);
  EXPECT_EQ(field("joints[2].gear_output_torque_Nm").unit, "Nm");
}

TEST_F(DecoderTest, GivesTheStamp) {
  ASSERT_EQ(open(joint_state(1, 1)), Fault::kNone);
  EXPECT_EQ(view_.session(), 77);
  ASSERT_TRUE(view_.stamp().has_value());
  EXPECT_EQ(view_.stamp()->utime_us, 123456);
  EXPECT_EQ(view_.stamp()->seq, 42);
}

TEST_F(DecoderTest, GivesTextsOfAnyLength) {
  auto message = motion_state();
  message.state_name = "thrust";
  message.last_transition = "";
  ASSERT_EQ(open(message), Fault::kNone);
  EXPECT_EQ(view_.text(field("state_name")), "thrust");
  EXPECT_EQ(view_.text(field("last_transition")), "");
  const Layout* first = view_.layout();
  message.state_name = "";
  message.last_transition = "touched down";
  message.jumps_done = 7;
  ASSERT_EQ(open(message), Fault::kNone);
  EXPECT_EQ(view_.layout(), first);
  EXPECT_EQ(view_.text(field("state_name")), "");
  EXPECT_EQ(view_.text(field("last_transition")), "touched down");
  EXPECT_EQ(view_.integer(field("jumps_done")), 7);
}

TEST_F(DecoderTest, NamesValuesOfEnumerations) {
  auto message = motion_state();
  message.legs[0].phase = 3;
  message.state = 99;
  ASSERT_EQ(open(message), Fault::kNone);
  EXPECT_STREQ(view_.enumeration(field("legs[0].phase")), "thrust");
  EXPECT_STREQ(view_.enumeration(field("state")), "unknown");
  EXPECT_EQ(view_.enumeration(field("jumps_done")), nullptr);
}

TEST_F(DecoderTest, ListsOfBytesAreOneField) {
  sprung_msgs::can_trace_t trace{};
  trace.n = 1;
  trace.frames.resize(1);
  trace.frames[0].data[7] = 0xAB;
  ASSERT_EQ(open(trace), Fault::kNone);
  const auto data = view_.bytes(field("frames[0].data"));
  ASSERT_EQ(data.size(), 8u);
  EXPECT_EQ(data[7], 0xAB);
  EXPECT_TRUE(std::isnan(number("frames[0].data")));
}

TEST_F(DecoderTest, BytesThatHoldTextAreText) {
  sprung_msgs::bus_state_t state{};
  state.n_nodes = 1;
  state.nodes.resize(1);
  std::snprintf(reinterpret_cast<char*>(state.nodes[0].recovery), 128, "reset, booted");
  ASSERT_EQ(open(state), Fault::kNone);
  EXPECT_EQ(view_.text(field("nodes[0].recovery")), "reset, booted");
  std::fill(std::begin(state.nodes[0].recovery), std::end(state.nodes[0].recovery), std::uint8_t{'x'});
  ASSERT_EQ(open(state), Fault::kNone);
  EXPECT_EQ(view_.text(field("nodes[0].recovery")).size(), 128u);
}

TEST_F(DecoderTest, KeepsTheLayoutWhileCountsStay) {
  ASSERT_EQ(open(joint_state(2, 1)), Fault::kNone);
  const Layout* first = view_.layout();
  ASSERT_EQ(open(joint_state(3, 1)), Fault::kNone);
  EXPECT_NE(view_.layout(), first);
  ASSERT_EQ(open(joint_state(2, 1)), Fault::kNone);
  EXPECT_EQ(view_.layout(), first);
}

TEST_F(DecoderTest, ForgetsLayoutsThatAreTooMany) {
  for (int round = 0; round < 2; ++round) {
    for (int n = 0; n < 100; ++n) {
      sprung_msgs::can_trace_t trace{};
      trace.n = n;
      trace.frames.resize(static_cast<std::size_t>(n));
      if (n > 0) trace.frames.back().can_id = 1000 + n;
      ASSERT_EQ(open(trace), Fault::kNone);
      if (n == 0) continue;
      EXPECT_EQ(number("frames[" + std::to_string(n - 1) + "].can_id"), 1000 + n);
    }
  }
}

TEST_F(DecoderTest, RefusesNegativeAndHugeCounts) {
  auto bytes = encoded(joint_state(1, 1));
  for (const int high : {0xFF, 0x80, 0x7F, 0x01}) {
    auto bad = bytes;
    bad[32] = static_cast<std::uint8_t>(high);
    EXPECT_EQ(decoder_.open(bad.data(), bad.size(), view_), Fault::kBadCount) << high;
  }
  bytes[35] = 2;
  EXPECT_NE(decoder_.open(bytes.data(), bytes.size(), view_), Fault::kNone);
}

TEST_F(DecoderTest, RefusesEveryTruncationAndTrailingBytes) {
  auto message = motion_state();
  message.state_name = "landing";
  auto bytes = encoded(message);
  ASSERT_EQ(decoder_.open(bytes.data(), bytes.size(), view_), Fault::kNone);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(decoder_.open(cut.data(), size, view_), Fault::kNone) << size;
  }
  bytes.push_back(0);
  EXPECT_EQ(decoder_.open(bytes.data(), bytes.size(), view_), Fault::kTrailing);
}

TEST_F(DecoderTest, RefusesBrokenTexts) {
  auto message = motion_state();
  message.state_name = "landing";
  const auto bytes = encoded(message);
  const std::size_t length_at = bytes.size() - 5 - 8 - 4;
  for (const std::uint8_t length : {std::uint8_t{0}, std::uint8_t{7}, std::uint8_t{200}}) {
    auto bad = bytes;
    bad[length_at + 3] = length;
    EXPECT_EQ(decoder_.open(bad.data(), bad.size(), view_), Fault::kBadText) << int{length};
  }
  auto negative = bytes;
  negative[length_at] = 0xFF;
  EXPECT_EQ(decoder_.open(negative.data(), negative.size(), view_), Fault::kBadText);
}

TEST_F(DecoderTest, SaysThatATypeIsUnknown) {
  auto bytes = encoded(joint_state(1, 1));
  bytes[0] ^= 1U;
  EXPECT_EQ(decoder_.open(bytes.data(), bytes.size(), view_), Fault::kUnknownType);
  EXPECT_EQ(decoder_.open(bytes.data(), 7, view_), Fault::kTooShort);
}

TEST_F(DecoderTest, ReadsTypesOfOthersToo) {
  TypeTable table;
  table.add({"package user; struct point_t { int16_t n; float xy[n][2]; string names[n]; }"});
  const StructType* type = table.by_name("point_t");
  ASSERT_NE(type, nullptr);
  std::vector<std::uint8_t> bytes;
  for (int i = 7; i >= 0; --i)
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(type->hash) >> (8 * i)));
  const std::vector<std::uint8_t> body = {0, 1, 0x3F, 0x80, 0, 0, 0xC0, 0x20, 0, 0, 0, 0, 0, 2, 'a', 0};
  bytes.insert(bytes.end(), body.begin(), body.end());
  Decoder decoder(table);
  ASSERT_EQ(decoder.open(bytes.data(), bytes.size(), view_), Fault::kNone);
  EXPECT_EQ(number("xy[0][0]"), 1.0);
  EXPECT_EQ(number("xy[0][1]"), -2.5);
  EXPECT_EQ(view_.text(field("names[0]")), "a");
  EXPECT_FALSE(view_.stamp().has_value());
  EXPECT_EQ(view_.session(), 0);
}

TEST_F(DecoderTest, RingsOfTypesEnd) {
  TypeTable table;
  table.add({"struct ring_t { int32_t n; ring_t next[n]; }"});
  std::vector<std::uint8_t> bytes;
  for (int i = 7; i >= 0; --i)
    bytes.push_back(
        static_cast<std::uint8_t>(static_cast<std::uint64_t>(table.by_name("ring_t")->hash) >> (8 * i)));
  std::vector<std::uint8_t> shallow = bytes;
  shallow.insert(shallow.end(), {0, 0, 0, 1, 0, 0, 0, 0});
  for (int i = 0; i < 100000; ++i) bytes.insert(bytes.end(), {0, 0, 0, 1});
  Decoder decoder(table);
  EXPECT_EQ(decoder.open(shallow.data(), shallow.size(), view_), Fault::kNone);
  EXPECT_EQ(decoder.open(bytes.data(), bytes.size(), view_), Fault::kBadCount);
}

}  // namespace
}  // namespace sprung::fields
