/// SDO sessions and looks at nodes against a device in a thread of its own, over a memory: bus:
/// sdo_session.h, node_inspection.h. The device serves SDO by hand, so that it can be silent, slow or double.
#include "tools/can/sdo_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "drivers/canopen/protocol.h"
#include "drivers/canopen/sdo_server.h"
#include "tests/support/device_thread.h"
#include "tools/can/node_inspection.h"

namespace sprung {
namespace {

using testing::HasSubstr;

constexpr int kNode = 5;

class SdoSessionTest : public testing::Test {
 protected:
  void hear(const CanFrame& frame) {
    if (frame.id != canopen::sdo_client_id(kNode)) return;
    for (int i = 0; i < copies_; ++i) answer(canopen::decode_sdo_request(frame));
  }

  void answer(const canopen::SdoMessage& request) {
    static constexpr char kName[] = "a long name";
    const auto* name = reinterpret_cast<const std::uint8_t*>(kName);
    if (request.kind == canopen::SdoKind::kUploadSegment) {
      send(request.toggle ? canopen::sdo_read_segment_reply(kNode, true, name + 7, 4, true)
                          : canopen::sdo_read_segment_reply(kNode, false, name, 7, false));
    } else if (request.kind == canopen::SdoKind::kUpload && request.object.index == 0x1000) {
      send(canopen::sdo_read_reply(kNode, request.object, 0x20192, 4));
    } else if (request.kind == canopen::SdoKind::kUpload && request.object.index == 0x1008) {
      send(canopen::sdo_read_begin_reply(kNode, request.object, 11));
    } else if (request.kind == canopen::SdoKind::kDownload && request.object.index == 0x1017) {
      send(canopen::sdo_write_reply(kNode, request.object));
    } else {
      send(canopen::sdo_server_abort(kNode, request.object, canopen::kAbortNoObject));
    }
  }
  void send(const CanFrame& frame) { wire_->send(&frame, 1); }

  std::unique_ptr<CanBus> bus_ = open_can_bus("memory:sdo_session_test");
  std::unique_ptr<CanBus> wire_ = open_can_bus("memory:sdo_session_test");
  std::atomic<int> copies_{1};
  test::DeviceThread device_{*wire_, [this](const CanFrame& frame) { hear(frame); }};
};

TEST_F(SdoSessionTest, ReadsExpeditedAndSegmented) {
  SdoSession session(*bus_, kNode, 5.0);
  EXPECT_EQ(session.must_read({0x1000, 0}).number(), 0x20192u);
  const SdoAnswer name = session.must_read({0x1008, 0});
  EXPECT_EQ(std::string(name.bytes.begin(), name.bytes.end()), "a long name");
}

TEST_F(SdoSessionTest, WritesAndReportsAborts) {
  SdoSession session(*bus_, kNode, 5.0);
  EXPECT_TRUE(session.write({0x1017, 0}, {5, 0}).done());
  const SdoAnswer refused = session.write({0x6072, 0}, {5, 0});
  EXPECT_EQ(refused.status, canopen::SdoStatus::kAborted);
  EXPECT_EQ(refused.abort_code, canopen::kAbortNoObject);
  try {
    session.must_write({0x6072, 0}, {5, 0});
    FAIL() << "not refused";
  } catch (const SdoFailed& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("node 5"), HasSubstr("writing 0x6072:00"),
                                             HasSubstr("no such object")));
  }
}

TEST_F(SdoSessionTest, SilenceSaysWhatToLookAt) {
  SdoSession session(*bus_, kNode + 1, 0.002);
  try {
    session.must_read({0x1000, 0});
    FAIL() << "not refused";
  } catch (const SdoFailed& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("no answer"), HasSubstr("powered"), HasSubstr("lock-step")));
  }
}

TEST_F(SdoSessionTest, ScanFindsTheOneNodeAndItsTwin) {
  std::vector<FoundNode> found = scan_nodes(*bus_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, kNode);
  EXPECT_EQ(found[0].answers, 1);
  EXPECT_EQ(found[0].device_type, 0x20192u);
  copies_ = 2;
  found = scan_nodes(*bus_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].answers, 2);
}

TEST_F(SdoSessionTest, AMasterIsHeardByItsSync) {
  EXPECT_FALSE(bridge_drives(*bus_));
  send(canopen::sync_frame());
  EXPECT_TRUE(bridge_drives(*bus_));
  send(canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational));
  EXPECT_TRUE(bridge_drives(*bus_));
}

TEST_F(SdoSessionTest, InspectionLeavesOutWhatTheNodeHasNot) {
  SdoSession session(*bus_, kNode, 5.0);
  const auto report = identify_node(session, nullptr);
  ASSERT_EQ(report.size(), 1u);  // no identity objects
  EXPECT_EQ(report[0].name, "device name");
  EXPECT_EQ(report[0].text, "\"a long name\"");
}

/// A device with one long object, in a thread of its own.
class LongObject : public testing::Test, protected canopen::SdoObjects {
 protected:
  std::uint32_t read(canopen::ObjectId, std::uint8_t* bytes, std::size_t,
                     std::size_t& size) noexcept override {
    size = value_.size();
    std::copy(value_.begin(), value_.end(), bytes);
    return 0;
  }
  std::uint32_t write(canopen::ObjectId, const std::uint8_t* bytes, std::size_t size,
                      bool) noexcept override {
    value_.assign(bytes, bytes + size);
    return 0;
  }
  void hear(const CanFrame& frame) {
    if (frame.id != canopen::sdo_client_id(kNode)) return;
    const bool block = canopen::decode_sdo_request(frame).kind >= canopen::SdoKind::kBlockDownloadBegin;
    blocks_ += block ? 1 : 0;
    CanFrame out;
    if (block && !has_blocks_) {
      out = canopen::sdo_server_abort(kNode, {0, 0}, canopen::kAbortCommand);
      wire_->send(&out, 1);
      return;
    }
    if (server_.receive(frame, 0, out)) wire_->send(&out, 1);
    while (server_.step(0, out)) wire_->send(&out, 1);
  }

  std::vector<std::uint8_t> value_;
  std::atomic<bool> has_blocks_{true};
  std::atomic<int> blocks_{0};
  canopen::SdoServer server_{kNode, *this};
  std::unique_ptr<CanBus> bus_ = open_can_bus("memory:sdo_session_long_test");
  std::unique_ptr<CanBus> wire_ = open_can_bus("memory:sdo_session_long_test");
  test::DeviceThread device_{*wire_, [this](const CanFrame& frame) { hear(frame); }};
};

TEST_F(LongObject, TravelsInBlocks) {
  SdoSession session(*bus_, kNode, 5.0);
  const std::vector<std::uint8_t> bytes(3000, 0x5A);
  session.must_write({0x2100, 0}, bytes);
  EXPECT_GT(blocks_, 0);
  EXPECT_EQ(session.must_read({0x2100, 0}, canopen::SdoService::kBlock).bytes, bytes);
}

TEST_F(LongObject, TravelsInSegmentsWhereTheServerHasNoBlocks) {
  has_blocks_ = false;
  SdoSession session(*bus_, kNode, 5.0);
  const std::vector<std::uint8_t> bytes(300, 0x5A);
  session.must_write({0x2100, 0}, bytes);
  EXPECT_EQ(session.must_read({0x2100, 0}, canopen::SdoService::kBlock).bytes, bytes);
  EXPECT_EQ(blocks_, 2) << "asked once each";
}

TEST_F(LongObject, ShortReadsDoNotAskForBlocks) {
  SdoSession session(*bus_, kNode, 5.0);
  session.must_write({0x2100, 0}, {1, 2, 3, 4});
  EXPECT_EQ(session.must_read({0x2100, 0}).number(), 0x04030201U);
  EXPECT_EQ(blocks_, 0);
}

}  // namespace
}  // namespace sprung
