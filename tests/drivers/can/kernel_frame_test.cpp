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

TEST(KernelFrame, FdFramesKeepAllOfTheirBytesAndFlags) {
  CanFdFrame frame;
  frame.id = 0x123;
  frame.length = 64;
  frame.fast = true;
  for (std::size_t i = 0; i < 64; ++i) frame.data[i] = static_cast<std::uint8_t>(i);
  const canfd_frame raw = fd_to_kernel(frame);
  EXPECT_EQ(raw.len, 64);
  EXPECT_EQ(raw.flags & CANFD_BRS, CANFD_BRS);
  const CanFdFrame back = fd_from_kernel(raw);
  EXPECT_EQ(back.id, frame.id);
  EXPECT_EQ(back.data, frame.data);
  EXPECT_TRUE(back.fast);
  EXPECT_FALSE(back.passive || back.extended);
}

TEST(KernelFrame, FdFramesMayHaveLongIdentifiersAndNoMoreThan64Bytes) {
  canfd_frame raw{};
  raw.can_id = 0x18DAF110 | CAN_EFF_FLAG;
  raw.len = 200;
  raw.flags = CANFD_ESI;
  const CanFdFrame frame = fd_from_kernel(raw);
  EXPECT_TRUE(frame.extended && frame.passive);
  EXPECT_EQ(frame.id, 0x18DAF110u);
  EXPECT_EQ(frame.length, 64);
}

}  // namespace
}  // namespace sprung
