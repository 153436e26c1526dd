#include "tools/logs/recorder/message_queue.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <thread>

namespace sprung {
namespace {

std::string text_of(const MessageQueue::Batch& batch) {
  std::string out;
  batch.for_each(
      [&](std::int64_t time_us, std::string_view channel, const std::uint8_t* data, std::size_t size) {
        out += std::to_string(time_us) + ":" + std::string(channel) + "=" +
               std::string(reinterpret_cast<const char*>(data), size) + " ";
      });
  return out;
}

TEST(MessageQueue, GivesMessagesInTheirOrder) {
  MessageQueue queue;
  queue.push(1, "A", "one", 3);
  queue.push(2, "BB", "", 0);
  queue.push(3, "A", "two", 3);
  MessageQueue::Batch batch;
  queue.take(batch);
  EXPECT_EQ(text_of(batch), "1:A=one 2:BB= 3:A=two ");
}

TEST(MessageQueue, TakesEachMessageOnce) {
  MessageQueue queue;
  MessageQueue::Batch batch;
  queue.push(1, "A", "x", 1);
  queue.take(batch);
  queue.take(batch);
  EXPECT_EQ(batch.size(), 0u);
  queue.push(2, "B", "y", 1);
  queue.take(batch);
  EXPECT_EQ(text_of(batch), "2:B=y ");
}

TEST(MessageQueue, RemembersItsLongest) {
  MessageQueue queue;
  MessageQueue::Batch batch;
  for (int i = 0; i < 5; ++i) queue.push(i, "A", "x", 1);
  queue.take(batch);
  queue.push(9, "A", "x", 1);
  EXPECT_EQ(queue.longest(), 5u);
}

TEST(MessageQueue, LimitLeavesOutWhatDoesNotFitAndCountsIt) {
  MessageQueue queue(10);
  queue.push(1, "A", "12345", 5);
  queue.push(2, "A", "6789", 4);  // one byte too many, with its channel
  queue.push(3, "A", "678", 3);
  MessageQueue::Batch batch;
  queue.take(batch);
  EXPECT_EQ(text_of(batch), "1:A=12345 3:A=678 ");
  EXPECT_EQ(queue.left_out(), 1);
  queue.push(4, "A", "12345", 5);
  queue.take(batch);
  EXPECT_EQ(text_of(batch), "4:A=12345 ");
  EXPECT_EQ(queue.left_out(), 1);
}

/// No limit, no loss, no disorder between two threads.
TEST(MessageQueue, LosesNothingBetweenThreads) {
  constexpr std::int64_t kMessages = 100'000;
  MessageQueue queue;
  std::thread sender([&] {
    for (std::int64_t i = 0; i < kMessages; ++i) queue.push(i, "CHANNEL", &i, sizeof i);
  });
  std::int64_t next = 0;
  bool right = true;
  for (MessageQueue::Batch batch; next < kMessages;) {
    queue.take(batch);
    batch.for_each(
        [&](std::int64_t time_us, std::string_view channel, const std::uint8_t* data, std::size_t size) {
          std::int64_t value = -1;
          if (size == sizeof value) std::memcpy(&value, data, size);
          right = right && time_us == next && value == next && channel == "CHANNEL";
          ++next;
        });
  }
  sender.join();
  EXPECT_TRUE(right);
}

}  // namespace
}  // namespace sprung
