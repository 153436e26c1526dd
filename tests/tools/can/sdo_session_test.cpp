/// SDO sessions and looks at nodes against a device in a thread of its own, over a memory: bus:
/// sdo_session.h, node_inspection.h. The device serves SDO by hand, so that it can be silent, slow or double.
#include "tools/can/sdo_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "drivers/canopen/protocol.h"
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

}  // namespace
}  // namespace sprung
