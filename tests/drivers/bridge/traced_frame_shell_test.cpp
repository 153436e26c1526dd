#include "drivers/bridge/traced_frame_shell.h"

#include <gtest/gtest.h>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/nmt.h"

namespace sprung {
namespace {

TEST(TracedFrame, DataFrameKeepsItsIdentifierTimeAndBytes) {
  CanFrame frame;
  frame.id = 0x181;
  frame.length = 3;
  frame.data = {1, 2, 3};
  const sprung_msgs::traced_frame_t traced = traced_frame(2, frame, false, 1234567);
  EXPECT_EQ(traced.can_id, 0x181);
  EXPECT_EQ(traced.utime, 1234567);
  EXPECT_EQ(traced.bus, 2);
  EXPECT_EQ(traced.sent, 0);
  EXPECT_EQ(traced.dlc, 3);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(traced.data[i], frame.data[i]);
  EXPECT_EQ(traced_frame(0, frame, true, 0).sent, 1);
}

TEST(TracedFrame, ErrorAndRemoteFramesCarrySocketCansFlags) {
  EXPECT_EQ(traced_frame(0, bus_lost_frame(), false, 0).can_id, 0x20000040);
  EXPECT_EQ(traced_frame(0, canopen::guard_request(5), true, 0).can_id, 0x40000705);
}

}  // namespace
}  // namespace sprung
