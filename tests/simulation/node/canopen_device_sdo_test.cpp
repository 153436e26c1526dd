// SDO transfers, and every code by which one is refused.
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "drivers/canopen/objects.h"
#include "tests/simulation/node/canopen_device_fixture.h"
#include "tests/support/allocation_count.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;

constexpr std::uint32_t kSave = 0x65766173;
constexpr std::uint32_t kLoad = 0x64616F6C;

TEST_F(CanopenDeviceTest, ServesSdoAndTellsTheApplicationOfWrites) {
  EXPECT_EQ(read(canopen::kIdentity, 2), 0x00030923U);
  EXPECT_EQ(write(canopen::kControlWord, 0, 6, 2), 0U);
  EXPECT_EQ(last_written, canopen::kControlWord);
  nmt(NmtCommand::kStart);
  EXPECT_EQ(write(canopen::kControlWord, 0, 7, 2), 0U);
  EXPECT_EQ(dictionary.get({canopen::kControlWord, 0}), 7);
}

TEST_F(CanopenDeviceTest, ServesSegmentedTransfersBothWays) {
  EXPECT_EQ(read_bytes(0x1008), "Elmo Gold drive");
  EXPECT_EQ(write_bytes(0x2012, 0, std::string("\x01\x02\x03\x04\x05\x06\x07\x08", 8)), 0U);
  EXPECT_EQ(dictionary.get({0x2012, 0}), 0x0807060504030201);
  EXPECT_EQ(last_written, 0x2012);
}

TEST_F(CanopenDeviceTest, GivesUpATransferThatTheClientForgets) {
  ask(canopen::sdo_read_request(kNode, {0x1008, 0}));
  drop();
  tick_until(canopen::SdoServer::kDefaultTimeout_us);
  const auto replies = frames(0x583);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(canopen::decode_sdo_reply(replies[0]).value, canopen::kAbortTimeout);
}

TEST_F(EposDeviceTest, ReadsAndWritesWithoutAllocating) {
  nmt(NmtCommand::kStart);
  const CanFrame requests[] = {canopen::sdo_read_request(kNode, {0x1008, 0}),
                               canopen::sdo_read_segment_request(kNode, false),
                               canopen::sdo_write_request(kNode, {0x1010, 1}, kSave, 4),
                               canopen::sdo_write_request(kNode, {0x1011, 1}, kLoad, 4),
                               canopen::nmt_frame(NmtCommand::kResetNode, 0),
                               canopen::guard_request(kNode)};
  const std::int64_t before = test::allocation_count();
  for (const CanFrame& request : requests) receive(request);
  node.raise(0x2310);
  tick_until(2000);
  node.power_cycle();
  EXPECT_EQ(test::allocation_count(), before);
}

/// An EPOS2 with a label that can be written and a domain that is empty.
canopen::Eds with_label() {
  canopen::Eds eds = load_eds("epos2", NodeBench::kNode);
  canopen::EdsObject label;
  label.id = {0x2100, 0};
  label.type = ObjectType::kVisibleString;
  label.access = Access::kReadWrite;
  canopen::EdsObject program = label;
  program.id = {0x2101, 0};
  program.type = ObjectType::kDomain;
  eds.objects.push_back(label);
  eds.objects.push_back(program);
  return eds;
}

/// Every code of facts canopen 1.4: the request that raises it, or why this device never does.
TEST_F(EposDeviceTest, RaisesEveryAbortCodeWhereItShould) {
  const auto raw = [this](const CanFrame& frame) { return ask(frame).value; };
  const auto start_read = [this] { ask(canopen::sdo_read_request(kNode, {0x1008, 0})); };
  const auto refuse = [this](std::uint32_t code) {
    refused_index = 0x6410;
    refusal = code;
    return write(0x6410, 1, 1000, 2);
  };
  const auto map_off = [this] {
    write(0x1801, 1, 0xC0000283, 4);
    write(0x1A01, 0, 0, 1);
  };
  const std::vector<std::pair<std::uint32_t, std::function<std::uint32_t()>>> rows = {
      {0x05030000, [&] { return start_read(), raw(canopen::sdo_read_segment_request(kNode, true)); }},
      {0x05040000,
       [&] {
         start_read();
         drop();
         tick_until(time_us + canopen::SdoServer::kDefaultTimeout_us);
         return canopen::decode_sdo_reply(frames(0x583).at(0)).value;
       }},
      {0x05040001,
       [&] {
         return raw({0x603, 8, {0xE0, 0x00, 0x10, 0}, false});
       }},  // no client command
      // 05040002, 3, 4 (block size, sequence, CRC): tests/drivers/canopen/sdo_server_test.cpp.
      {0x05040005,
       [&] {
         return raw(canopen::sdo_write_begin(kNode, {0x1017, 0}, 100000));
       }},
      // 06010000 (access unsupported): every object here can be read or written, and has a code of its own.
      {0x06010001, [&] { return read(0x20C1); }},
      {0x06010002, [&] { return write(0x6041, 0, 0, 2); }},
      {0x06020000, [&] { return read(0x603F); }},
      {0x06040041, [&] { return map_off(), write(0x1A01, 1, 0x64100510, 4); }},
      {0x06040042,
       [&] {
         map_off();
         for (int sub = 1; sub <= 3; ++sub) write(0x1A01, sub, 0x60640020, 4);
         return write(0x1A01, 0, 3, 1);
       }},
      {0x06040043,
       [&] {
         write(0x1016, 1, (127U << 16) | 20U, 4);
         return write(0x1016, 2, (127U << 16) | 20U, 4);
       }},
      // 06040047 (internal incompatibility), 06060000 (hardware), 08000000 (general), 08000021 (local
      // control), 08000023 (no dictionary): a simulated device has no such state; an application may raise
      // them by check_write() as below.
      {0x06060000, [&] { return refuse(canopen::kAbortHardware); }},
      {0x06070010,
       [&] {
         NodeBench label(with_label());
         return label.write_bytes(0x2100, 0, std::string(ObjectDictionary::kTextBytes + 1, 'x'));
       }},
      {0x06070012, [&] { return write(0x1017, 0, 5, 4); }},
      {0x06070013, [&] { return write(0x1017, 0, 5, 1); }},
      {0x06090011, [&] { return read(0x1018, 9); }},
      {0x06090030, [&] { return write(0x1800, 2, 245, 1); }},
      {0x06090031, [&] { return write(0x6410, 1, 5001, 2); }},
      {0x06090032, [&] { return write(0x2210, 1, 15, 4); }},
      // 06090036 (maximum below minimum): the application's, which knows the pairs.
      {0x06090036, [&] { return refuse(canopen::kAbortMaxBelowMin); }},
      {0x060A0023, [&] { return refuse(canopen::kAbortResource); }},
      {0x08000020, [&] { return write(0x1010, 1, 1, 4); }},
      {0x08000022, [&] { return write(0x1A00, 0, 0, 1); }},  // TPDO1 is valid
      {0x08000024,
       [&] {
         NodeBench label(with_label());
         return label.read(0x2101);
       }},
      {0x0F00FFC0,
       [&] {
         DevicePolicy policy;
         policy.remap_in_operational = canopen::kAbortMaxonNmtState;
         NodeBench strict("epos2", policy);
         strict.nmt(NmtCommand::kStart);
         return strict.write(0x1801, 1, 0xC0000283, 4);
       }},
      // 0F00FFBF, -FFBE, -FFBC, -FFB9 (command, password, service mode, node id): of maxon's service
      // commands, which are not simulated.
  };
  for (const auto& [code, request] : rows) EXPECT_EQ(request(), code) << std::hex << code;
}

}  // namespace
}  // namespace sprung::sim
