#include "tools/logs/recorder/network_tap.h"

#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include "tests/runtime/lcm_network.h"

namespace sprung {
namespace {

using Lcm = std::unique_ptr<lcm_t, void (*)(lcm_t*)>;

class NetworkTapTest : public testing::Test {
 protected:
  void send(const char* channel, std::int32_t value) {
    ASSERT_EQ(lcm_publish(sender_.get(), channel, &value, sizeof value), 0);
  }
  /// Whether so many have come; while nobody takes any, the queue's longest is all of them.
  bool have_come(std::size_t messages) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (queue_.longest() < messages && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return queue_.longest() >= messages;
  }
  const std::string url_ = test::own_lcm_url();
  Lcm sender_{lcm_create(url_.c_str()), lcm_destroy};
  MessageQueue queue_;
  MessageQueue::Batch batch_;
};

/// Above 64 kB LCM sends fragments, three of them here.
TEST_F(NetworkTapTest, LargeMessageIsPutTogether) {
  NetworkTap tap(url_, ".*", queue_);
  std::vector<std::uint8_t> large(150'000);
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  ASSERT_EQ(lcm_publish(sender_.get(), "LARGE", large.data(), static_cast<unsigned>(large.size())), 0);
  ASSERT_TRUE(have_come(1));
  tap.stop();
  queue_.take(batch_);
  batch_.for_each([&](std::int64_t, std::string_view channel, const std::uint8_t* data, std::size_t size) {
    EXPECT_EQ(channel, "LARGE");
    EXPECT_EQ(std::vector<std::uint8_t>(data, data + size), large);
  });
}

/// More than LCM's queue of 30 by far, and nobody takes them until the end. The kernel's buffer is finite
/// (200 kB by default): no more are on their way at once than it holds.
TEST_F(NetworkTapTest, TakesEveryMessageWhateverTheWriterDoes) {
  constexpr std::int32_t kMessages = 5000;
  NetworkTap tap(url_, ".*", queue_);
  for (std::int32_t i = 0; i < kMessages; ++i) {
    send(i % 2 == 0 ? "EVEN" : "ODD", i);
    if (i % 100 == 99) {
      ASSERT_TRUE(have_come(static_cast<std::size_t>(i) + 1)) << i;
    }
  }
  tap.stop();
  queue_.take(batch_);
  ASSERT_EQ(batch_.size(), static_cast<std::size_t>(kMessages));
  std::int32_t next = 0;
  batch_.for_each(
      [&](std::int64_t time_us, std::string_view channel, const std::uint8_t* data, std::size_t size) {
        std::int32_t value = -1;
        ASSERT_EQ(size, sizeof value);
        std::memcpy(&value, data, size);
        EXPECT_EQ(value, next++);
        EXPECT_EQ(channel, value % 2 == 0 ? "EVEN" : "ODD");
        EXPECT_GT(time_us, 1'600'000'000'000'000);  // wall time
      });
}

TEST_F(NetworkTapTest, LeavesOutChannelsThatWereNotAskedFor) {
  NetworkTap tap(url_, "JOINT_.*", queue_);
  send("DRIVE_STATE", 1);
  send("JOINT_STATE", 2);
  EXPECT_TRUE(have_come(1));
  tap.stop();
  queue_.take(batch_);
  EXPECT_EQ(batch_.size(), 1u);
}

TEST_F(NetworkTapTest, StopsTwiceWithoutHarm) {
  NetworkTap tap(url_, ".*", queue_);
  tap.stop();
  tap.stop();
}

TEST_F(NetworkTapTest, AddressThatIsNoneIsNamed) {
  try {
    NetworkTap tap("nonsense://x", ".*", queue_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense://x"), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung
