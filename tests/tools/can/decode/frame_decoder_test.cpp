#include "tools/can/decode/frame_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "tests/support/enumerators.h"

namespace sprung::cantools {
namespace {

using testing::HasSubstr;

class FrameDecoderTest : public testing::Test {
 protected:
  DecodedFrame decode(const CanFrame& frame) { return decoder_.decode({0, 0, Direction::kUnknown, frame}); }
  std::string text(const CanFrame& frame) { return decode(frame).text; }

  static CanFrame data(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    CanFrame frame;
    frame.id = id;
    for (const std::uint8_t byte : bytes) frame.data[frame.length++] = byte;
    return frame;
  }
  /// Writes an object of node 1 as a master would, acknowledged.
  void write(canopen::ObjectId object, std::uint32_t value, int size) {
    decode(canopen::sdo_write_request(1, object, value, size));
    decode(canopen::sdo_write_reply(1, object));
  }

  FrameDecoder decoder_{describe_buses(load_robot("single_leg"))};
};

TEST(FrameKinds, EveryOneHasItsOwnName) { test::expect_own_names<FrameKind>(); }

TEST_F(FrameDecoderTest, NmtCommandsNameTheirNode) {
  const DecodedFrame one = decode(canopen::nmt_frame(canopen::NmtCommand::kResetCommunication, 2));
  EXPECT_EQ(one.kind, FrameKind::kNmt);
  EXPECT_EQ(one.node_name, "knee_motor");
  EXPECT_EQ(one.text, "reset communication");
  EXPECT_EQ(decode(canopen::nmt_frame(canopen::NmtCommand::kStart, 0)).node_name, "all nodes");
  EXPECT_THAT(text(data(0x000, {0x55, 1})), HasSubstr("not understood: 55 01"));
}

TEST_F(FrameDecoderTest, SyncAndItsCounter) {
  EXPECT_EQ(decode(canopen::sync_frame()).kind, FrameKind::kSync);
  EXPECT_EQ(text(data(0x080, {7})), "counter 7");
}

TEST_F(FrameDecoderTest, EmergencyTellsCodeRegisterAndMakersBytes) {
  canopen::Emergency emergency;
  emergency.code = 0x2310;
  emergency.error_register = 0x03;
  const DecodedFrame decoded = decode(canopen::emergency_frame(1, emergency));
  EXPECT_EQ(decoded.kind, FrameKind::kEmergency);
  EXPECT_EQ(decoded.node_name, "hip_motor");
  EXPECT_THAT(decoded.text, HasSubstr("0x2310 "));
  EXPECT_THAT(decoded.text, HasSubstr(canopen::emergency_text(0x2310)));
  EXPECT_THAT(decoded.text, HasSubstr("generic, current"));
  emergency.maker = {0, 1, 0, 0, 0xFF};
  EXPECT_THAT(text(canopen::emergency_frame(1, emergency)), HasSubstr("maker's bytes 00 01 00 00 FF"));
}

TEST_F(FrameDecoderTest, SampleInDriveAndJointUnits) {
  // 131072 counts x 100 turns = one turn of the joint.
  const DecodedFrame decoded = decode(data(0x181, {0x00, 0x00, 0xC8, 0x00, 0xE8, 0x03, 0x37, 0x02}));
  EXPECT_EQ(decoded.kind, FrameKind::kTpdo);
  ASSERT_EQ(decoded.fields.size(), 3u);
  EXPECT_EQ(decoded.fields[0].name, "position actual");
  EXPECT_EQ(decoded.fields[0].value.number, 13107200);
  EXPECT_NEAR(decoded.fields[0].joint.at(0).value, 6.283185307, 1e-9);
  EXPECT_EQ(decoded.fields[1].value.number, 1000);
  EXPECT_NEAR(decoded.fields[1].joint.at(1).value, 30.8, 1e-9);  // 0.044 Nm/A x 7 A x 100
  EXPECT_EQ(decoded.text,
            "1: position actual 13107200 counts = 6.28319 rad, torque actual 1000 per mille of rated torque "
            "= 7 A = 30.8 "
            "Nm, status word 0x0237 (operation enabled: voltage enabled, remote)");
}

TEST_F(FrameDecoderTest, SetpointsAreNamedToo) {
  const DecodedFrame decoded = decode(data(0x202, {0x18, 0xFC, 0, 0, 0, 0, 10}));
  EXPECT_EQ(decoded.kind, FrameKind::kRpdo);
  EXPECT_EQ(decoded.node_name, "knee_motor");
  ASSERT_EQ(decoded.fields.size(), 3u);
  EXPECT_EQ(decoded.fields[0].value.number, -1000);
  EXPECT_THAT(decoded.text, HasSubstr("10 (cyclic torque)"));
}

TEST_F(FrameDecoderTest, WrongLengthIsSaidNotGuessed) {
  EXPECT_EQ(text(data(0x181, {1, 2, 3})), "1: 01 02 03 (3 bytes, the map has 8)");
  EXPECT_TRUE(decode(data(0x181, {1, 2, 3})).fields.empty());
}

TEST_F(FrameDecoderTest, NodesThatTheRobotHasNotKeepTheirNumber) {
  const DecodedFrame decoded = decode(data(0x285, {1}));
  EXPECT_EQ(decoded.kind, FrameKind::kTpdo);
  EXPECT_EQ(decoded.node_name, "node 5");
  EXPECT_EQ(decoded.text, "2: 01 (map not known)");
}

TEST_F(FrameDecoderTest, FollowsARemapSeenOnTheBus) {
  write({0x1800, 1}, 0xC0000181, 4);
  EXPECT_THAT(text(data(0x181, {1, 2})), HasSubstr("map not known"));  // disabled: whose frame is it?
  write({0x1A00, 0}, 0, 1);
  write({0x1A00, 1}, 0x60770010, 4);
  write({0x1A00, 0}, 1, 1);
  write({0x1800, 1}, 0x400001F0, 4);
  const DecodedFrame decoded = decode(data(0x1F0, {0xE8, 0x03}));
  EXPECT_EQ(decoded.node_name, "hip_motor");
  ASSERT_EQ(decoded.fields.size(), 1u);
  EXPECT_EQ(decoded.fields[0].name, "torque actual");
  decode(canopen::heartbeat_frame(1, canopen::NmtState::kBootUp));
  EXPECT_EQ(decode(data(0x181, {0, 0, 0, 0, 0, 0, 0, 0})).fields.size(), 3u);  // the robot's own map again
}

TEST_F(FrameDecoderTest, AWriteThatWasNotAcknowledgedChangesNothing) {
  decode(canopen::sdo_write_request(1, {0x1A00, 0}, 0, 1));
  decode(canopen::sdo_server_abort(1, {0x1A00, 0}, canopen::kAbortDeviceState));
  EXPECT_EQ(decode(data(0x181, {0, 0, 0, 0, 0, 0, 0, 0})).fields.size(), 3u);
}

TEST_F(FrameDecoderTest, ExpeditedTransfersNameObjectValueAndUnit) {
  EXPECT_EQ(text(canopen::sdo_read_request(1, {0x6079, 0})), "read 0x6079:00 DC link voltage");
  EXPECT_EQ(text(canopen::sdo_read_reply(1, {0x6079, 0}, 48000, 4)), "0x6079:00 DC link voltage = 48000 mV");
  EXPECT_EQ(text(canopen::sdo_write_request(1, {0x1017, 0}, 5, 2)),
            "write 0x1017:00 heartbeat producer := 5 ms");
  EXPECT_EQ(text(canopen::sdo_write_reply(1, {0x1017, 0})), "0x1017:00 heartbeat producer written: 5 ms");
}

TEST_F(FrameDecoderTest, AbortsAreText) {
  text(canopen::sdo_read_request(1, {0x2FFF, 3}));
  EXPECT_EQ(text(canopen::sdo_server_abort(1, {0x2FFF, 3}, canopen::kAbortNoObject)),
            "abort 0x2FFF:03 object: 0x06020000 no such object");
}

TEST_F(FrameDecoderTest, SegmentsAreToldWithTheirObjectAndTheWholeValueAtTheEnd) {
  const std::string name = "Gold drive";
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(name.data());
  text(canopen::sdo_read_request(1, {0x1008, 0}));
  EXPECT_THAT(text(canopen::sdo_read_begin_reply(1, {0x1008, 0}, name.size())),
              HasSubstr("in segments, 10 bytes"));
  EXPECT_THAT(text(canopen::sdo_read_segment_request(1, false)), HasSubstr("next segment of 0x1008:00"));
  EXPECT_THAT(text(canopen::sdo_read_segment_reply(1, false, bytes, 7, false)),
              HasSubstr("segment of 7 bytes of 0x1008:00"));
  EXPECT_THAT(text(canopen::sdo_read_segment_reply(1, true, bytes + 7, 3, true)),
              HasSubstr("= \"Gold drive\""));
}

TEST_F(FrameDecoderTest, SegmentedWritesToo) {
  const std::uint8_t bytes[] = {'a', 'b', 'c', 'd', 'e'};
  EXPECT_THAT(text(canopen::sdo_write_begin(1, {0x1008, 0}, 5)), HasSubstr("in segments, 5 bytes"));
  EXPECT_THAT(text(canopen::sdo_write_reply(1, {0x1008, 0})), HasSubstr("go on"));
  text(canopen::sdo_write_segment(1, false, bytes, 5, true));
  EXPECT_THAT(text(canopen::sdo_write_segment_reply(1, false)), HasSubstr("written: \"abcde\""));
}

TEST_F(FrameDecoderTest, ATraceMayBeginInTheMiddleOfATransfer) {
  const std::uint8_t bytes[] = {1};
  EXPECT_THAT(text(canopen::sdo_read_segment_reply(1, false, bytes, 1, true)),
              HasSubstr("asked for before the trace began"));
}

TEST_F(FrameDecoderTest, TransfersOfTwoNodesDoNotMix) {
  decode(canopen::sdo_write_request(1, {0x1017, 0}, 5, 2));
  decode(canopen::sdo_write_request(2, {0x1017, 0}, 9, 2));
  EXPECT_THAT(text(canopen::sdo_write_reply(1, {0x1017, 0})), HasSubstr("5 ms"));
  EXPECT_THAT(text(canopen::sdo_write_reply(2, {0x1017, 0})), HasSubstr("9 ms"));
}

TEST_F(FrameDecoderTest, HeartbeatsBootUpAndGuarding) {
  EXPECT_EQ(text(canopen::heartbeat_frame(1, canopen::NmtState::kOperational)), "operational");
  EXPECT_EQ(text(canopen::heartbeat_frame(1, canopen::NmtState::kBootUp)), "boot-up");
  EXPECT_EQ(decode(canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational)).node_name,
            "bridge");
  EXPECT_EQ(text(canopen::guard_request(1)), "guarding: state?");
  EXPECT_EQ(text(canopen::guard_reply(1, {canopen::NmtState::kStopped, true})),
            "guarding: stopped, toggle 1");
  EXPECT_EQ(text(canopen::heartbeat_frame(1, canopen::NmtState::kStopped)), "stopped");
}

TEST_F(FrameDecoderTest, ErrorFramesAndStrangers) {
  CanFrame error = data(0x40, {0, 0, 0, 0, 0, 0, 0, 0});
  error.error = true;
  EXPECT_EQ(decode(error).kind, FrameKind::kError);
  EXPECT_EQ(text(error), "bus off");
  EXPECT_EQ(decode(data(0x7E5, {4, 1})).kind, FrameKind::kLss);
  EXPECT_EQ(decode(data(0x100, {})).kind, FrameKind::kTime);
  EXPECT_EQ(decode(data(0x050, {1})).kind, FrameKind::kUnknown);
}

TEST(FrameDecoder, WithoutARobotObjectsHaveTheStandardsNames) {
  FrameDecoder decoder{BusDescription{}};
  const DecodedFrame decoded = decoder.decode(
      {0, 0, Direction::kUnknown, canopen::sdo_read_request(9, {0x6041, 0})});
  EXPECT_EQ(decoded.node_name, "node 9");
  EXPECT_EQ(decoded.text, "read 0x6041:00 status word");
}

}  // namespace
}  // namespace sprung::cantools
