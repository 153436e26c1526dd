#include <gtest/gtest.h>

#include "simulation/bus_schedule.h"

namespace sprung::sim {
namespace {

CanFrame frame(std::uint32_t id) { return {id, 0, {}, false}; }

TEST(FrameQueue, GivesFramesByTimeAndThenByArrival) {
  FrameQueue queue;
  queue.push({200, 0, frame(1)});
  queue.push({100, 0, frame(2)});
  queue.push({200, 1, frame(3)});
  queue.push({100, 0, frame(4)});
  queue.push({150, 0, frame(5)});
  std::vector<std::uint32_t> order;
  while (queue.next_us() != FrameQueue::kNever) order.push_back(queue.pop().frame.id);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{2, 4, 5, 1, 3}));
}

TEST(FrameQueue, RefusesWhenFull) {
  FrameQueue queue;
  for (std::size_t i = 0; i < FrameQueue::kCapacity; ++i) ASSERT_TRUE(queue.push({0, 0, frame(1)}));
  EXPECT_FALSE(queue.push({0, 0, frame(2)}));
  queue.pop();
  EXPECT_TRUE(queue.push({0, 0, frame(2)}));
}

}  // namespace
}  // namespace sprung::sim
