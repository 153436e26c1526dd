#include "drivers/can/memory_bus.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

CanFrame numbered(int number) {
  CanFrame frame;
  frame.id = 0x100;
  frame.length = 1;
  frame.data[0] = static_cast<std::uint8_t>(number & 0xFF);
  return frame;
}

class MemoryBusTest : public testing::Test {
 protected:
  std::shared_ptr<MemoryMedium> medium_ = std::make_shared<MemoryMedium>("test");
  MemoryBus a_{medium_}, b_{medium_}, c_{medium_};
  CanFrame received_[8];
};

TEST_F(MemoryBusTest, EveryOtherEndpointSeesFramesInOrder) {
  CanFrame frames[] = {numbered(1), numbered(2), numbered(3)};
  frames[1].remote = true;
  EXPECT_TRUE(a_.send(frames, 3));
  for (MemoryBus* bus : {&b_, &c_}) {
    ASSERT_EQ(bus->receive(received_, 8), 3);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(received_[i], frames[i]);
    EXPECT_EQ(bus->counters().received, 3);
  }
  EXPECT_EQ(a_.receive(received_, 8), 0) << "own frames must not come back";
  EXPECT_EQ(a_.counters().sent, 3);
}

TEST_F(MemoryBusTest, ReceiveLeavesWhatDoesNotFit) {
  const CanFrame frames[] = {numbered(1), numbered(2), numbered(3)};
  a_.send(frames, 3);
  EXPECT_EQ(b_.receive(received_, 2), 2);
  ASSERT_EQ(b_.receive(received_, 2), 1);
  EXPECT_EQ(received_[0], frames[2]);
}

TEST_F(MemoryBusTest, FullQueueCountsWhatItDrops) {
  for (int i = 0; i < 5000; ++i) {
    const CanFrame frame = numbered(i);
    a_.send(&frame, 1);
  }
  EXPECT_EQ(b_.counters().dropped, 5000 - 4096);
  ASSERT_EQ(b_.receive(received_, 1), 1);
  EXPECT_EQ(received_[0], numbered(0));
}

TEST_F(MemoryBusTest, LeavingEndpointIsForgotten) {
  {
    MemoryBus brief{medium_};
    const CanFrame frame = numbered(7);
    EXPECT_TRUE(brief.send(&frame, 1));
  }
  const CanFrame frame = numbered(8);
  EXPECT_TRUE(a_.send(&frame, 1));
  EXPECT_EQ(b_.receive(received_, 8), 2);
}

}  // namespace
}  // namespace sprung
