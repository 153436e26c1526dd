#include "simulation/node/master_watch.h"

#include <gtest/gtest.h>

#include "drivers/canopen/objects.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

using Change = MasterWatch::Change;
using canopen::NmtState;

class MasterWatchTest : public testing::Test {
 protected:
  void consume(int sub, int node, int time_ms) {
    dictionary_.set(NodeBench::id(canopen::kHeartbeatConsumer, sub), (node << 16) | time_ms);
  }
  Change hear(int node, std::int64_t time_us) {
    return watch_.hear(canopen::heartbeat_frame(node, NmtState::kOperational), time_us);
  }
  /// The answer's byte, or -1.
  int guard(std::int64_t time_us) {
    CanFrame reply;
    bool answers = false;
    change_ = watch_.guard(3, NmtState::kPreOperational, time_us, reply, answers);
    return answers ? reply.data[0] : -1;
  }

  ObjectDictionary dictionary_{load_eds("epos2", 3)};
  MasterWatch watch_{dictionary_};
  Change change_ = Change::kNone;
};

TEST_F(MasterWatchTest, HeartbeatIsSupervisedFromTheFirstOneOn) {
  consume(1, 127, 20);
  EXPECT_EQ(watch_.check(100000), Change::kNone);
  EXPECT_EQ(hear(127, 100000), Change::kNone);
  EXPECT_EQ(watch_.check(119999), Change::kNone);
  EXPECT_EQ(watch_.check(120000), Change::kLost);
  EXPECT_EQ(watch_.check(140000), Change::kNone);  // told once
  EXPECT_TRUE(watch_.lost());
  EXPECT_EQ(hear(127, 150000), Change::kBack);
  EXPECT_FALSE(watch_.lost());
}

TEST_F(MasterWatchTest, EveryConsumerHasItsOwnTimeAndAllMustComeBack) {
  consume(1, 127, 20);
  consume(2, 126, 50);
  hear(127, 0);
  hear(126, 0);
  EXPECT_EQ(watch_.check(20000), Change::kLost);
  EXPECT_EQ(watch_.check(50000), Change::kLost);
  EXPECT_EQ(hear(127, 60000), Change::kNone);
  EXPECT_EQ(hear(126, 60000), Change::kBack);
}

TEST_F(MasterWatchTest, OtherNodesHeartbeatsDoNotCount) {
  consume(1, 127, 20);
  hear(127, 0);
  hear(5, 19000);
  EXPECT_EQ(watch_.check(20000), Change::kLost);
}

TEST_F(MasterWatchTest, RewrittenConsumerWaitsForItsFirstHeartbeat) {
  consume(1, 127, 20);
  hear(127, 0);
  watch_.rearm(1);
  EXPECT_EQ(watch_.check(100000), Change::kNone);
  watch_.rearm(0);  // the count of entries: nothing of it
}

TEST_F(MasterWatchTest, GuardAnswersToggleFromZero) {
  EXPECT_EQ(guard(0), 0x7F);
  EXPECT_EQ(guard(1000), 0xFF);
  EXPECT_EQ(guard(2000), 0x7F);
  guard(3000);
  watch_.restart();
  EXPECT_EQ(guard(4000), 0x7F);
}

TEST_F(MasterWatchTest, LifeTimeIsGuardTimeTimesFactor) {
  dictionary_.set({canopen::kGuardTime, 0}, 10);
  dictionary_.set({canopen::kLifeTimeFactor, 0}, 3);
  EXPECT_EQ(watch_.check(100000), Change::kNone);  // not asked yet
  guard(100000);
  EXPECT_EQ(watch_.check(129999), Change::kNone);
  EXPECT_EQ(watch_.check(130000), Change::kLost);
  guard(140000);
  EXPECT_EQ(change_, Change::kBack);
}

TEST_F(MasterWatchTest, LifeTimeZeroIsNotSupervised) {
  dictionary_.set({canopen::kGuardTime, 0}, 10);
  guard(0);
  EXPECT_EQ(watch_.check(10'000'000), Change::kNone);
}

TEST_F(MasterWatchTest, HeartbeatOfItsOwnExcludesGuarding) {
  dictionary_.set({canopen::kGuardTime, 0}, 10);
  dictionary_.set({canopen::kLifeTimeFactor, 0}, 3);
  guard(0);
  dictionary_.set({canopen::kHeartbeatProducer, 0}, 5);
  EXPECT_EQ(guard(1000), -1);
  EXPECT_EQ(watch_.check(10'000'000), Change::kNone);
  EXPECT_EQ(watch_.heartbeat_us(), 5000);
}

}  // namespace
}  // namespace sprung::sim
