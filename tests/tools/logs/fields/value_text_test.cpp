#include "tools/logs/fields/value_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sprung_msgs/can_trace_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "tests/signals/message_bytes.h"

namespace sprung::fields {
namespace {

class ValueText : public testing::Test {
 protected:
  template <class M>
  void open(const M& message) {
    bytes_ = test::encoded(message);
    ASSERT_EQ(decoder_.open(bytes_.data(), bytes_.size(), view_), Fault::kNone);
  }
  const Field& field(const char* path) { return view_.fields().at(view_.layout()->find(path)); }
  std::string text(const char* path, int digits = 6) { return value_text(view_, field(path), digits); }
  std::string exact(const char* path) {
    std::string out;
    append_exact(view_, field(path), out);
    return out;
  }

  Decoder decoder_;
  MessageView view_;
  std::vector<std::uint8_t> bytes_;
};

TEST_F(ValueText, ForPeople) {
  sprung_msgs::motion_state_t message{};
  message.n_legs = 1;
  message.legs.resize(1);
  message.legs[0].phase = 4;
  message.jump_height_scale = 1.0 / 3.0;
  message.jumps_left = -2;
  message.state_name = "flight";
  message.estimated_jump_height_m = -std::nan("");  // as 0 / 0 is on x86
  open(message);
  EXPECT_EQ(text("legs[0].phase"), "flight (4)");
  EXPECT_EQ(text("jump_height_scale"), "0.333333");
  EXPECT_EQ(text("jump_height_scale", 3), "0.333");
  EXPECT_EQ(text("jumps_left"), "-2");
  EXPECT_EQ(text("state_name"), "flight");
  EXPECT_EQ(text("estimated_jump_height_m"), "nan");
}

TEST_F(ValueText, ForMachinesGivesTheSameBits) {
  sprung_msgs::motion_state_t message{};
  message.jump_height_scale = 0.1 + 0.2;
  message.gait_phase = -std::numeric_limits<double>::infinity();
  message.estimated_jump_height_m = -std::nan("");
  message.state = 4;
  message.desired_speed[0] = std::numeric_limits<double>::denorm_min();
  open(message);
  EXPECT_EQ(std::stod(exact("jump_height_scale")), 0.1 + 0.2);
  EXPECT_EQ(exact("gait_phase"), "-inf");
  EXPECT_EQ(exact("estimated_jump_height_m"), "nan");
  EXPECT_EQ(exact("state"), "4");
  EXPECT_EQ(std::strtod(exact("desired_speed[0]").c_str(), nullptr),
            std::numeric_limits<double>::denorm_min());
}

TEST_F(ValueText, BytesAreHex) {
  sprung_msgs::can_trace_t trace{};
  trace.n = 1;
  trace.frames.resize(1);
  for (int i = 0; i < 8; ++i) trace.frames[0].data[i] = static_cast<std::uint8_t>(0x1F * i);
  open(trace);
  EXPECT_EQ(text("frames[0].data"), "001f3e5d7c9bbad9");
}

}  // namespace
}  // namespace sprung::fields
