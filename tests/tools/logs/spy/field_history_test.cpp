#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/logs/spy/sample_messages.h"
#include "tools/logs/spy/channel_book.h"

namespace sprung::spy {
namespace {

class FieldHistoryTest : public testing::Test {
 protected:
  void add(std::int64_t arrival_us, double torque_Nm) {
    add(arrival_us, test::joint_state_bytes(0, torque_Nm));
  }
  void add(std::int64_t arrival_us, const std::vector<std::uint8_t>& bytes) {
    ASSERT_EQ(decoder_.open(bytes.data(), bytes.size(), view_), fields::Fault::kNone);
    history_.add(arrival_us, view_);
    const int index = view_.layout()->find("joints[1].gear_output_torque_Nm");
    torque_ = index < 0 ? 0 : static_cast<std::size_t>(index);
  }
  fields::Decoder decoder_;
  fields::MessageView view_;
  FieldHistory history_;
  std::size_t torque_ = 0;
};

TEST_F(FieldHistoryTest, KeepsWhatComesInItsOrder) {
  for (int i = 0; i < 5; ++i) add(20'000 * i, i);
  EXPECT_EQ(history_.of(torque_), (std::vector<double>{0, 1, 2, 3, 4}));
}

TEST_F(FieldHistoryTest, TakesNoMoreThanFiftyASecond) {
  for (int i = 0; i < 100; ++i) add(2'000 * i, i);
  EXPECT_EQ(history_.of(torque_), (std::vector<double>{0, 10, 20, 30, 40, 50, 60, 70, 80, 90}));
}

TEST_F(FieldHistoryTest, ForgetsWhatIsOlderThanItsSamples) {
  for (int i = 0; i < 1234; ++i) add(20'000 * i, i);
  const auto values = history_.of(torque_);
  ASSERT_EQ(values.size(), FieldHistory::kSamples);
  EXPECT_EQ(values.front(), 1234 - static_cast<int>(FieldHistory::kSamples));
  EXPECT_EQ(values.back(), 1233);
}

TEST_F(FieldHistoryTest, BeginsAnewWithAnotherShape) {
  add(0, 1.0);
  add(20'000, test::encoded(test::motion_state(0, 3)));
  EXPECT_EQ(history_.of(0).size(), 1u);
  add(40'000, 2.0);
  EXPECT_EQ(history_.of(torque_), std::vector<double>{2.0});
}

TEST_F(FieldHistoryTest, GoesOnWhenTheClockIsSetBack) {
  add(1'000'000, 1.0);
  add(500'000, 2.0);
  EXPECT_EQ(history_.of(torque_).size(), 2u);
}

TEST_F(FieldHistoryTest, HasNothingOfFieldsThatAreNot) {
  EXPECT_TRUE(history_.of(0).empty());
  add(0, test::encoded(test::motion_state(0, 3)));
  EXPECT_TRUE(history_.of(10'000).empty());
  EXPECT_TRUE(std::isnan(history_.of(static_cast<std::size_t>(view_.layout()->find("state_name"))).at(0)));
}

}  // namespace
}  // namespace sprung::spy
