#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"

namespace sprung::canopen {
namespace {

std::vector<int> bytes(const CanFrame& frame) {
  return {frame.data.begin(), frame.data.begin() + frame.length};
}

// Bytes that python-canopen sent to node 1 (facts canopen 1.5).
TEST(SdoClient, RemapRequestsHaveTheBytesOfAnIndependentMaster) {
  const CanFrame disable = sdo_write_request(1, {0x1800, 1}, 0xC0000181, 4);
  EXPECT_EQ(disable.id, 0x601U);
  EXPECT_EQ(bytes(disable), (std::vector<int>{0x23, 0x00, 0x18, 0x01, 0x81, 0x01, 0x00, 0xC0}));
  EXPECT_EQ(bytes(sdo_write_request(1, {0x1800, 2}, 1, 1)),
            (std::vector<int>{0x2F, 0x00, 0x18, 0x02, 0x01, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_write_request(1, {0x1800, 3}, 10, 2)),
            (std::vector<int>{0x2B, 0x00, 0x18, 0x03, 0x0A, 0, 0, 0}));
  EXPECT_EQ(bytes(sdo_write_request(1, {0x1A00, 1}, encode_map_entry({{0x6064, 0}, 32}), 4)),
            (std::vector<int>{0x23, 0x00, 0x1A, 0x01, 0x20, 0x00, 0x64, 0x60}));
}

TEST(SdoServer, UnderstandsEveryRequestOfTheClient) {
  for (const int size : {1, 2, 3, 4}) {
    const std::uint32_t value = 0xA1B2C3D4U >> (8 * (4 - size));
    const SdoMessage write = decode_sdo_request(sdo_write_request(5, {0x6072, 7}, value, size));
    EXPECT_EQ(write.kind, SdoKind::kDownload);
    EXPECT_EQ(write.object, (ObjectId{0x6072, 7}));
    EXPECT_EQ(write.value, value);
    EXPECT_EQ(write.size, size);
  }
  const SdoMessage read = decode_sdo_request(sdo_read_request(5, {0x1018, 2}));
  EXPECT_EQ(read.kind, SdoKind::kUpload);
  EXPECT_EQ(read.object, (ObjectId{0x1018, 2}));
  EXPECT_EQ(decode_sdo_request(sdo_client_abort(5, {0x1018, 2}, kAbortTimeout)).kind, SdoKind::kAbort);
}

TEST(SdoClient, UnderstandsEveryReplyOfTheServer) {
  for (const int size : {1, 2, 3, 4}) {
    const std::uint32_t value = 0xA1B2C3D4U >> (8 * (4 - size));
    const CanFrame frame = sdo_read_reply(5, {0x6079, 0}, value, size);
    EXPECT_EQ(frame.id, 0x585U);
    const SdoMessage reply = decode_sdo_reply(frame);
    EXPECT_EQ(reply.kind, SdoKind::kUpload);
    EXPECT_EQ(reply.value, value);
    EXPECT_EQ(reply.size, size);
  }
  EXPECT_EQ(sdo_read_reply(1, {1, 0}, 0, 1).data[0], 0x4F);
  EXPECT_EQ(sdo_read_reply(1, {1, 0}, 0, 2).data[0], 0x4B);
  EXPECT_EQ(sdo_read_reply(1, {1, 0}, 0, 4).data[0], 0x43);
  EXPECT_EQ(decode_sdo_reply(sdo_write_reply(5, {0x1017, 0})).kind, SdoKind::kDownload);
  const SdoMessage abort = decode_sdo_reply(sdo_server_abort(5, {0x1017, 0}, kAbortNoObject));
  EXPECT_EQ(abort.kind, SdoKind::kAbort);
  EXPECT_EQ(abort.value, kAbortNoObject);
}

TEST(SdoFrames, ShortRemoteAndErrorFramesAreNone) {
  for (int kind = 0; kind < 3; ++kind) {
    CanFrame frame = sdo_read_request(1, {0x1008, 0});
    if (kind == 0) frame.length = 4;
    frame.remote = kind == 1;
    frame.error = kind == 2;
    EXPECT_EQ(decode_sdo_request(frame).kind, SdoKind::kInvalid) << kind;
    EXPECT_EQ(decode_sdo_reply(frame).kind, SdoKind::kInvalid) << kind;
  }
}

TEST(SdoServer, WriteWithoutToldSizeCarriesFourBytes) {
  CanFrame frame = sdo_write_request(1, {0x1017, 0}, 0x01020304, 4);
  frame.data[0] = 0x22;
  const SdoMessage message = decode_sdo_request(frame);
  EXPECT_EQ(message.kind, SdoKind::kDownload);
  EXPECT_EQ(message.size, 0);
  EXPECT_EQ(message.value, 0x01020304U);
}

TEST(Nmt, CommandReachesItsNodeAndAllNodesOnly) {
  NmtCommand command{};
  EXPECT_TRUE(decode_nmt(nmt_frame(NmtCommand::kStart, 3), 3, command));
  EXPECT_EQ(command, NmtCommand::kStart);
  EXPECT_FALSE(decode_nmt(nmt_frame(NmtCommand::kStop, 4), 3, command));
  EXPECT_TRUE(decode_nmt(nmt_frame(NmtCommand::kResetCommunication, 0), 3, command));
  EXPECT_EQ(command, NmtCommand::kResetCommunication);
  CanFrame unknown = nmt_frame(NmtCommand::kStart, 3);
  unknown.data[0] = 0x33;
  EXPECT_FALSE(decode_nmt(unknown, 3, command));
}

TEST(Heartbeat, StateSurvivesTheWireAndGuardToggleIsIgnored) {
  for (const NmtState state :
       {NmtState::kBootUp, NmtState::kStopped, NmtState::kOperational, NmtState::kPreOperational}) {
    CanFrame frame = heartbeat_frame(9, state);
    EXPECT_EQ(frame.id, 0x709U);
    EXPECT_EQ(heartbeat_state(frame), state);
    frame.data[0] |= 0x80;
    EXPECT_EQ(heartbeat_state(frame), state);
  }
  CanFrame odd = heartbeat_frame(9, NmtState::kOperational);
  odd.data[0] = 0x11;
  EXPECT_EQ(heartbeat_state(odd), NmtState::kUnknown);
  odd.length = 2;
  EXPECT_EQ(heartbeat_state(odd), NmtState::kUnknown);
}

TEST(Emergency, SurvivesTheWireAndHasAText) {
  Emergency found;
  ASSERT_TRUE(decode_emergency(emergency_frame(2, {0x8130, 0x11}), found));
  EXPECT_EQ(found.code, 0x8130);
  EXPECT_EQ(found.error_register, 0x11);
  EXPECT_STREQ(emergency_text(found.code), "life guard or heartbeat lost");
  EXPECT_STREQ(emergency_text(0x4310), "temperature");
  EXPECT_STREQ(emergency_text(0xFF20), "device specific");
}

TEST(MapEntry, WordHoldsIndexSubAndBits) {
  EXPECT_EQ(encode_map_entry({{0x607A, 1}, 32}), 0x607A0120U);
  const MapEntry entry = decode_map_entry(0x60410010);
  EXPECT_EQ(entry.object, (ObjectId{0x6041, 0}));
  EXPECT_EQ(entry.bits, 16);
}

TEST(CobIds, FollowThePredefinedConnectionSet) {
  EXPECT_EQ(tpdo_id(0, 1), 0x181U);
  EXPECT_EQ(tpdo_id(3, 2), 0x482U);
  EXPECT_EQ(rpdo_id(0, 1), 0x201U);
  EXPECT_EQ(rpdo_id(1, 2), 0x302U);
  EXPECT_EQ(emcy_id(1), 0x81U);
  EXPECT_EQ(sync_frame().id, 0x80U);
  EXPECT_EQ(sync_frame().length, 0);
}

TEST(Texts, EveryCodeAndObjectInUseHasItsOwnName) {
  EXPECT_STREQ(abort_text(kAbortReadOnly), "write of a read-only object");
  EXPECT_STREQ(abort_text(0x12345678), "unknown abort code");
  EXPECT_STREQ(object_name(kMaxTorque), "max torque");
  EXPECT_STREQ(object_name(0x1802), "transmit PDO settings");
  EXPECT_STREQ(object_name(0x1601), "receive PDO map");
  EXPECT_STREQ(object_name(0x5000), "object");
}

}  // namespace
}  // namespace sprung::canopen
