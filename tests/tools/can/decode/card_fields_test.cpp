#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/protocol.h"
#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "robots/robot_loader.h"
#include "tools/can/decode/decoded_field.h"
#include "tools/can/decode/frame_decoder.h"

namespace sprung::cantools {
namespace {

using testing::HasSubstr;

constexpr int kCard = 4;  // node of every card of pegasus
constexpr canopen::ObjectId kSampleObject{0x2100, 0};

CanFrame sample(int node, const encoder_card::Sample& values) {
  const std::uint64_t word = encoder_card::pack(values);
  CanFrame frame;
  frame.id = canopen::tpdo_id(0, node);
  frame.length = 8;
  for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(word >> (8 * i));
  return frame;
}

class CardFieldsTest : public testing::Test {
 protected:
  const NodeDescription& card(int bus) const { return *description_.find(bus, kCard); }
  BusDescription description_ = describe_buses(load_robot("pegasus"));
};

TEST_F(CardFieldsTest, CountsPositionsAndCounter) {
  const auto fields = card_fields(card(0), kSampleObject, sample(kCard, {{262144, 0, 1048575}, 15}));
  ASSERT_EQ(fields.size(), 4u);
  EXPECT_EQ(fields[0].name, "encoder 0 (fl_abduction_motor)");
  EXPECT_EQ(fields[0].value.number, 262144);
  EXPECT_EQ(fields[0].value.unit, "counts");
  // A quarter turn with direction -1 and offset 3.1416 rad.
  EXPECT_NEAR(fields[0].joint.at(0).value, 3.1416 - 1.5707963268, 1e-9);
  EXPECT_STREQ(fields[0].joint.at(0).unit, "rad");
  // Offset 4.8416 rad at count zero, seen within half a turn.
  EXPECT_NEAR(fields[1].joint.at(0).value, 4.8416 - 6.2831853072, 1e-9);
  EXPECT_EQ(fields[2].value.number, 1048575);
  EXPECT_EQ(fields[3].name, "counter");
  EXPECT_EQ(fields[3].value.number, 15);
  EXPECT_TRUE(fields[3].joint.empty());
}

TEST_F(CardFieldsTest, EachLegsCardNamesItsOwnActuatorsAndSigns) {
  const auto right = card_fields(card(1), kSampleObject, sample(kCard, {{0, 262144, 0}, 0}));
  EXPECT_EQ(right[1].name, "encoder 1 (fr_hip_motor)");
  EXPECT_NEAR(right[1].joint.at(0).value, -1.4416 + 1.5707963268, 1e-9);
}

TEST_F(CardFieldsTest, ChannelsThatRobotYamlDoesNotUseHaveCountsOnly) {
  NodeDescription bare = card(0);
  bare.card_channels.clear();
  const auto fields = card_fields(bare, kSampleObject, sample(kCard, {{5, 6, 7}, 1}));
  ASSERT_EQ(fields.size(), 4u);
  EXPECT_EQ(fields[2].name, "encoder 2");
  EXPECT_TRUE(fields[2].joint.empty());
}

TEST_F(CardFieldsTest, OtherNodesAndFramesHaveNone) {
  const CanFrame frame = sample(kCard, {});
  EXPECT_TRUE(card_fields(*description_.find(0, 1), kSampleObject, frame).empty());
  EXPECT_TRUE(card_fields(card(0), kSampleObject, sample(5, {})).empty());
  CanFrame cut = frame;
  cut.length = 7;
  EXPECT_TRUE(card_fields(card(0), kSampleObject, cut).empty());
}

TEST_F(CardFieldsTest, TheDecoderShowsThem) {
  FrameDecoder decoder(description_);
  const DecodedFrame decoded = decoder.decode({0, 0, Direction::kReceived, sample(kCard, {{1, 2, 3}, 9})});
  EXPECT_EQ(decoded.node_name, "fl_card");
  EXPECT_THAT(decoded.text, testing::StartsWith("1: encoder 0 (fl_abduction_motor) 1 counts = -3.14159 rad"));
  EXPECT_THAT(decoded.text, testing::EndsWith(", counter 9"));
}

TEST_F(CardFieldsTest, ACardWithAnotherMapIsReadByItsMap) {
  FrameDecoder decoder(description_);
  const auto write = [&](canopen::ObjectId object, std::uint32_t value, int size) {
    decoder.decode({0, 0, Direction::kSent, canopen::sdo_write_request(kCard, object, value, size)});
    decoder.decode({0, 0, Direction::kReceived, canopen::sdo_write_reply(kCard, object)});
  };
  write({0x1A00, 1}, 0x21010120, 4);
  write({0x1A00, 2}, 0x21010220, 4);
  write({0x1A00, 0}, 2, 1);
  const DecodedFrame decoded = decoder.decode({0, 0, Direction::kReceived, sample(kCard, {{1, 2, 3}, 9})});
  ASSERT_EQ(decoded.fields.size(), 2u);
  EXPECT_THAT(decoded.fields[0].name, HasSubstr("encoder 0"));
  EXPECT_THAT(decoded.text, testing::Not(HasSubstr("counter")));
}

}  // namespace
}  // namespace sprung::cantools
