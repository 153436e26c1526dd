#include "drivers/can/kernel_frame.h"

#include <gtest/gtest.h>
#include <linux/can/error.h>

namespace sprung {
namespace {

TEST(KernelFrame, DataFramesGoThereAndBack) {
  CanFrame frame;
  frame.id = 0x7FF;
  frame.length = 3;
  frame.data = {1, 2, 3};
  const can_frame raw = to_kernel(frame);
  EXPECT_EQ(raw.can_id, 0x7FFu);
  EXPECT_EQ(raw.can_dlc, 3);
  EXPECT_EQ(raw.data[2], 3);
  CanFrame back;
  ASSERT_TRUE(from_kernel(raw, back));
  EXPECT_EQ(back, frame);
}

TEST(KernelFrame, RemoteRequestsCarryTheirFlagAndNoData) {
  CanFrame frame;
  frame.id = 0x701;
  frame.length = 1;
  frame.data[0] = 0xAA;
  frame.remote = true;
  const can_frame raw = to_kernel(frame);
  EXPECT_EQ(raw.can_id, 0x701u | CAN_RTR_FLAG);
  EXPECT_EQ(raw.data[0], 0);
  CanFrame back;
  ASSERT_TRUE(from_kernel(raw, back));
  EXPECT_TRUE(back.remote);
  EXPECT_EQ(back.id, 0x701u);
  EXPECT_EQ(back.length, 1);
}

TEST(KernelFrame, ErrorFramesKeepTheirClassAndDetails) {
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF | CAN_ERR_CRTL;
  raw.can_dlc = CAN_ERR_DLC;
  raw.data[1] = CAN_ERR_CRTL_TX_PASSIVE;
  CanFrame frame;
  ASSERT_TRUE(from_kernel(raw, frame));
  EXPECT_TRUE(frame.error);
  EXPECT_FALSE(frame.remote);
  EXPECT_EQ(frame.id, static_cast<std::uint32_t>(CAN_ERR_BUSOFF | CAN_ERR_CRTL));
  EXPECT_EQ(frame.data[1], CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(to_kernel(frame).can_id, raw.can_id);
}

TEST(KernelFrame, ExtendedFramesAreRefused) {
  can_frame raw{};
  raw.can_id = 0x181 | CAN_EFF_FLAG;
  CanFrame frame;
  EXPECT_FALSE(from_kernel(raw, frame));
}

TEST(KernelFrame, LengthBeyondEightIsCut) {
  can_frame raw{};
  raw.can_dlc = 15;
  CanFrame frame;
  ASSERT_TRUE(from_kernel(raw, frame));
  EXPECT_EQ(frame.length, 8);
}

}  // namespace
}  // namespace sprung
