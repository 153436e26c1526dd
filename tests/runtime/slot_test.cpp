#include "runtime/slot.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <thread>
#include <vector>

#include "signals/stamp.h"

namespace sprung {
namespace {

struct Value {
  Stamp stamp;
  int content = 0;
};

Value value(std::int64_t seq, int content = 0) { return {{seq * 1000, seq}, content}; }

class SlotTest : public ::testing::Test {
 protected:
  void push(std::initializer_list<std::int64_t> seqs) {
    for (const std::int64_t seq : seqs) slot_.push(value(seq));
  }
  std::vector<std::int64_t> held() const {
    const HeldSeqs seqs = slot_.held();
    return {seqs.begin(), seqs.end()};
  }
  using Seqs = std::vector<std::int64_t>;
  Slot<Value> slot_{Value{}};
  Value out_;
};

TEST_F(SlotTest, IsEmptyAtFirst) {
  EXPECT_FALSE(slot_.newest(out_));
  EXPECT_FALSE(slot_.get(-1, out_));
  EXPECT_EQ(held(), Seqs{});
  EXPECT_EQ(slot_.held().newest(-7), -7);
  EXPECT_FALSE(slot_.take_repeated());
}

TEST_F(SlotTest, KeepsTheNewestFour) {
  push({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(held(), (Seqs{2, 3, 4, 5}));
  EXPECT_FALSE(slot_.get(1, out_));
  ASSERT_TRUE(slot_.get(3, out_));
  EXPECT_EQ(out_.stamp.utime_us, 3000);
  ASSERT_TRUE(slot_.newest(out_));
  EXPECT_EQ(out_.stamp.seq, 5);
}

TEST_F(SlotTest, FindsTheNewestAtOrBefore) {
  push({1, 3, 5});
  ASSERT_TRUE(slot_.newest_at_or_before(4, out_));
  EXPECT_EQ(out_.stamp.seq, 3);
  ASSERT_TRUE(slot_.newest_at_or_before(5, out_));
  EXPECT_EQ(out_.stamp.seq, 5);
  EXPECT_FALSE(slot_.newest_at_or_before(0, out_));
}

TEST_F(SlotTest, OrderOfArrivalDoesNotMatter) {
  push({4, 2, 5, 3});
  EXPECT_EQ(held(), (Seqs{2, 3, 4, 5}));
  push({6});
  EXPECT_EQ(held(), (Seqs{3, 4, 5, 6}));
}

TEST_F(SlotTest, ValueOlderThanAllHeldIsLate) {
  push({4, 5, 6, 7, 1});
  EXPECT_EQ(held(), (Seqs{4, 5, 6, 7}));
  EXPECT_EQ(slot_.late(), 1);
}

TEST_F(SlotTest, RepeatIsMarkedOnceAndTheFirstValueStays) {
  slot_.push(value(1, 10));
  slot_.push(value(1, 20));
  ASSERT_TRUE(slot_.get(1, out_));
  EXPECT_EQ(out_.content, 10);
  EXPECT_EQ(slot_.take_repeated(), 1);
  EXPECT_FALSE(slot_.take_repeated());
}

TEST_F(SlotTest, NewestRepeatIsReported) {
  push({1, 2, 2, 1});
  EXPECT_EQ(slot_.take_repeated(), 2);
}

TEST_F(SlotTest, SenderThatStartsAnewEmptiesTheSlot) {
  push({20, 21, 22, 23, 0});
  EXPECT_EQ(held(), (Seqs{0}));
  push({1});
  EXPECT_EQ(held(), (Seqs{0, 1}));
}

TEST_F(SlotTest, FallingBackALittleIsNotANewStart) {
  push({20, 20 - kRestartGap});
  EXPECT_EQ(held(), (Seqs{20 - kRestartGap, 20}));
  push({20 - kRestartGap - 1});
  EXPECT_EQ(held(), (Seqs{20 - kRestartGap - 1}));
}

TEST_F(SlotTest, PushWakesTheNode) {
  InputEvent event;
  slot_.wake(&event);
  pollfd wait{event.fd(), POLLIN, 0};
  EXPECT_EQ(poll(&wait, 1, 0), 0);
  push({1, 1});
  EXPECT_EQ(poll(&wait, 1, 0), 1);
  event.clear();
  EXPECT_EQ(poll(&wait, 1, 0), 0);
}

TEST_F(SlotTest, ReaderNeverSeesHalfAValue) {
  constexpr int kValues = 20'000;
  std::thread writer([this] {
    for (int i = 0; i < kValues; ++i) slot_.push(value(i, i));
  });
  std::int64_t last = -1;
  while (last < kValues - 1) {
    if (!slot_.newest(out_)) continue;
    ASSERT_EQ(out_.stamp.seq, out_.content);
    ASSERT_EQ(out_.stamp.utime_us, out_.stamp.seq * 1000);
    ASSERT_GE(out_.stamp.seq, last);
    last = out_.stamp.seq;
  }
  writer.join();
}

}  // namespace
}  // namespace sprung
