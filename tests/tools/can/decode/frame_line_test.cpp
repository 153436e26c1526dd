#include "tools/can/decode/frame_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"

namespace sprung::cantools {
namespace {

CanFrame data(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  CanFrame frame;
  frame.id = id;
  for (const std::uint8_t byte : bytes) frame.data[frame.length++] = byte;
  return frame;
}

class FrameLineTest : public testing::Test {
 protected:
  static ObservedFrame seen(const CanFrame& frame, Direction direction = Direction::kReceived) {
    return {3'500'000, 0, direction, frame};
  }
  std::string line(const ObservedFrame& observed) {
    return frame_line(observed, decoder_.decode(observed), "leg", 1'000'000);
  }
  nlohmann::ordered_json json(const ObservedFrame& observed) {
    return frame_json(observed, decoder_.decode(observed), "leg", 1'000'000);
  }
  FrameDecoder decoder_{describe_buses(load_robot("single_leg"))};
};

TEST_F(FrameLineTest, TimeCountsFromTheBeginningAndTheArrowShowsTheWay) {
  const CanFrame heartbeat = canopen::heartbeat_frame(1, canopen::NmtState::kOperational);
  EXPECT_EQ(line(seen(heartbeat)), "     2.500000 leg    <- 701 heartbeat   hip_motor: operational");
  EXPECT_EQ(line(seen(heartbeat, Direction::kSent)),
            "     2.500000 leg    -> 701 heartbeat   hip_motor: operational");
  EXPECT_EQ(line(seen(heartbeat, Direction::kUnknown)),
            "     2.500000 leg       701 heartbeat   hip_motor: operational");
}

TEST_F(FrameLineTest, APdoNumberFollowsItsNodeWithoutAColon) {
  EXPECT_THAT(line(seen(data(0x182, {1, 2, 3}))),
              testing::HasSubstr("182 TPDO        knee_motor 1: 01 02 03"));
}

TEST_F(FrameLineTest, NothingTrailsAFrameWithoutNodeAndText) {
  EXPECT_EQ(line(seen(canopen::sync_frame(), Direction::kSent)), "     2.500000 leg    -> 080 SYNC");
  EXPECT_EQ(line(seen(data(0x080, {7}))), "     2.500000 leg    <- 080 SYNC        counter 7");
}

TEST_F(FrameLineTest, JsonHoldsBytesDirectionAndFields) {
  const auto out = json(seen(data(0x181, {0x00, 0x00, 0xC8, 0x00, 0xE8, 0x03, 0x37, 0x02})));
  EXPECT_EQ(out["time_us"], 2'500'000);
  EXPECT_EQ(out["direction"], "received");
  EXPECT_EQ(out["id"], 0x181);
  EXPECT_EQ(out["data"], "0000C800E8033702");
  EXPECT_EQ(out["kind"], "TPDO");
  EXPECT_EQ(out["node"], 1);
  EXPECT_EQ(out["name"], "hip_motor");
  ASSERT_EQ(out["fields"].size(), 3u);
  EXPECT_EQ(out["fields"][0]["object"], "0x6064:00");
  EXPECT_EQ(out["fields"][0]["value"], 13107200);
  EXPECT_EQ(out["fields"][0]["unit"], "counts");
  EXPECT_NEAR(out["fields"][0]["joint"]["rad"].get<double>(), 6.283185307, 1e-9);
  EXPECT_EQ(out["fields"][2].count("joint"), 0u);
}

TEST_F(FrameLineTest, JsonOfAFrameOfNobodyHasNoNode) {
  const auto out = json(seen(canopen::sync_frame(), Direction::kUnknown));
  EXPECT_TRUE(out["node"].is_null());
  EXPECT_EQ(out["direction"], "unknown");
  EXPECT_EQ(out["data"], "");
  EXPECT_TRUE(out["fields"].empty());
}

TEST_F(FrameLineTest, ARemoteRequestHasNoBytes) {
  EXPECT_EQ(json(seen(canopen::guard_request(1)))["data"], "");
}

TEST(NumberJson, WideNumbersStayUnsignedAndTextsAreNull) {
  const std::uint8_t bytes[8] = {1, 0, 0, 0, 0, 0, 0, 0x80};
  EXPECT_EQ(number_json(object_value(nullptr, {0x2100, 0}, bytes, 8)).dump(), "9223372036854775809");
  EXPECT_EQ(number_json({-5, "-5", "", false}).dump(), "-5");
  EXPECT_TRUE(number_json({std::nullopt, "\"text\"", "", false}).is_null());
}

TEST(FdFrameLine, SaysWhatItIsAndDecodesNothing) {
  ObservedFdFrame observed;
  observed.time_us = 1'500'000;
  observed.frame.id = 0x181;
  observed.frame.length = 12;
  observed.frame.fast = true;
  observed.frame.data[0] = 0xAB;
  EXPECT_EQ(fd_frame_line(observed, "leg", 1'000'000),
            "     0.500000 leg       181 CAN FD [12] BRS AB0000000000000000000000");
  EXPECT_EQ(fd_frame_json(observed, "leg", 0).at("bit_rate_switch"), true);
}

}  // namespace
}  // namespace sprung::cantools
