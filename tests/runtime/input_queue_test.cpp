#include "runtime/input_queue.h"

#include <gtest/gtest.h>
#include <poll.h>

namespace sprung {
namespace {

TEST(InputQueue, GivesBackInOrderOfArrival) {
  InputQueue<int> queue;
  queue.push(3);
  queue.push(1);
  EXPECT_EQ(queue.pop(), 3);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_FALSE(queue.pop());
}

TEST(InputQueue, DropsAndCountsWhatDoesNotFit) {
  InputQueue<int> queue(2);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(queue.overflow(), 3);
  EXPECT_EQ(queue.pop(), 0);
  queue.push(9);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 9);
}

TEST(InputQueue, PushWakesTheNode) {
  InputEvent event;
  InputQueue<int> queue;
  queue.wake(&event);
  queue.push(1);
  pollfd wait{event.fd(), POLLIN, 0};
  EXPECT_EQ(poll(&wait, 1, 0), 1);
}

}  // namespace
}  // namespace sprung
