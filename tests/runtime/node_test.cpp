#include "runtime/node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <poll.h>

#include <atomic>
#include <thread>

#include "lcmtypes/channels.h"
#include "runtime/stop_request.h"
#include "signals/leg_command.h"
#include "signals/operator.h"
#include "tests/runtime/lcm_network.h"

namespace sprung {
namespace {

constexpr std::int64_t kSession = 77;
constexpr std::int64_t kLong_us = 20'000'000;

class NodeTest : public ::testing::Test {
 protected:
  NodeOptions options(std::vector<std::string> inject = {}, std::int64_t session = kSession) const {
    return {url_, session, 0, std::move(inject)};
  }
  static LegCommand command(std::int64_t seq) {
    LegCommand result(1);
    result.stamp = {seq * 1000, seq};
    result.legs[0].stiffness_N_m[2] = 545.0;
    return result;
  }
  /// Waits until the condition holds. @return whether it did in time.
  template <class Condition>
  static bool eventually(Node& node, Condition condition) {
    const std::int64_t end_us = node.utime_us() + kLong_us;
    while (!condition()) {
      if (node.utime_us() > end_us) return false;
      node.wait_for_input(node.utime_us() + 10'000);
    }
    return true;
  }

  const std::string url_ = test::own_lcm_url();
  Slot<LegCommand> slot_{LegCommand(1)};
  LegCommand out_;
};

TEST_F(NodeTest, TwoNodesTalk) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  Node sender(options());
  auto publisher = sender.publisher<LegCommand>(channels::kLegCommand);
  publisher.publish(command(3));
  ASSERT_TRUE(eventually(receiver, [&] { return slot_.get(3, out_); }));
  EXPECT_EQ(out_.stamp.utime_us, 3000);
  EXPECT_EQ(out_.legs.at(0).stiffness_N_m[2], 545.0);
  EXPECT_EQ(receiver.refused_messages(), 0);
}

TEST_F(NodeTest, ByteHandlersRestAfterAGoodMessageAndNotAfterABadOne) {
  Node receiver(options());
  std::atomic<int> resting{0}, waking{0};
  const auto count_in = [](std::atomic<int>& calls) {
    return [&calls](const std::uint8_t*, std::size_t) { ++calls; };
  };
  receiver.on_bytes<sprung_msgs::leg_command_t>(channels::kLegCommand, CountLimits::exactly(1), kLong_us,
                                                count_in(resting));
  receiver.on_bytes<sprung_msgs::leg_command_t>(channels::kLegCommand, CountLimits::exactly(1), 0,
                                                count_in(waking));
  const Receiving receiving(receiver);
  Node sender(options());
  auto publisher = sender.publisher<LegCommand>(channels::kLegCommand);
  publisher.publish(LegCommand(2));  // of a robot of two legs
  for (int seq = 1; seq <= 3; ++seq) publisher.publish(command(seq));
  ASSERT_TRUE(eventually(receiver, [&] { return waking == 3; }));
  EXPECT_EQ(resting, 1);
  EXPECT_EQ(receiver.refused_messages(), 2) << "the bad one, by both";
}

/// A burst that the kernel's buffer holds (200 kB by default): UDP drops what comes to a full one.
TEST_F(NodeTest, BurstEndsInTheNewestFour) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  Node sender(options());
  auto publisher = sender.publisher<LegCommand>(channels::kLegCommand);
  for (std::int64_t seq = 0; seq < 50; ++seq) publisher.publish(command(seq));
  ASSERT_TRUE(eventually(receiver, [&] { return slot_.held().newest(-1) == 49; }));
  EXPECT_EQ(slot_.held().count, 4);
  EXPECT_EQ(slot_.held().seqs[0], 46);
}

TEST_F(NodeTest, RefusesOtherSessionsAndOtherRobots) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  Node other_session(options({}, kSession + 1));
  other_session.publisher<LegCommand>(channels::kLegCommand).publish(command(1));
  ASSERT_TRUE(eventually(receiver, [&] { return receiver.refused_messages() == 1; }));
  EXPECT_EQ(receiver.last_refusal(), "LEG_COMMAND refused: wrong session, found 78, expected 77");
  Node other_robot(options());
  other_robot.publisher<LegCommand>(channels::kLegCommand).publish(LegCommand(4));
  ASSERT_TRUE(eventually(receiver, [&] { return receiver.refused_messages() == 2; }));
  EXPECT_THAT(receiver.last_refusal(), ::testing::HasSubstr("bad count, found 4, expected 1"));
  EXPECT_EQ(slot_.held().count, 0);
}

TEST_F(NodeTest, RubbishOnAChannelIsCountedAndNothingElse) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  lcm_t* const raw = lcm_create(url_.c_str());
  ASSERT_NE(raw, nullptr);
  const std::vector<std::uint8_t> rubbish(200, 0xFF);
  for (const unsigned size : {0U, 1U, 40U, 200U})
    lcm_publish(raw, channels::kLegCommand, rubbish.data(), size);
  EXPECT_TRUE(eventually(receiver, [&] { return receiver.refused_messages() == 4; }));
  lcm_destroy(raw);
}

TEST_F(NodeTest, UnknownEnumerationValueIsRefused) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  Node sender(options());
  sprung_msgs::leg_command_t message{};
  message.n_legs = 1;
  message.legs.resize(1);
  message.legs[0].control_mode = 99;
  sender.publish_message(channels::kLegCommand, message);
  ASSERT_TRUE(eventually(receiver, [&] { return receiver.refused_messages() == 1; }));
  EXPECT_THAT(receiver.last_refusal(), ::testing::HasSubstr("bad value, found 99, expected 0 to 4"));
}

TEST_F(NodeTest, MessagesWithTextsArriveInAQueue) {
  Node receiver(options({}, 0));  // a tool: any session
  InputQueue<sprung_msgs::operator_reply_t> replies;
  receiver.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies);
  const Receiving receiving(receiver);
  Node sender(options());
  OperatorReply reply;
  reply.request_id = 5;
  reply.reason = "not standing";
  sender.publisher<OperatorReply>(channels::kOperatorReply).publish(reply);
  std::optional<sprung_msgs::operator_reply_t> got;
  ASSERT_TRUE(eventually(receiver, [&] { return (got = replies.pop()).has_value(); }));
  EXPECT_EQ(got->request_id, 5);
  EXPECT_EQ(got->reason, "not standing");
  EXPECT_EQ(got->session, kSession);
}

TEST_F(NodeTest, InjectedFaultsHitTheirMessageOnce) {
  Node receiver(options({"drop-rx:LEG_COMMAND:1"}));
  InputQueue<LegCommand> all;
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), all);
  const Receiving receiving(receiver);
  Node sender(options({"drop-tx:LEG_COMMAND:2", "repeat-tx:LEG_COMMAND:3"}));
  auto publisher = sender.publisher<LegCommand>(channels::kLegCommand);
  for (const std::int64_t seq : {1, 2, 3, 1, 2, 3, 9}) publisher.publish(command(seq));
  std::vector<std::int64_t> seqs;
  ASSERT_TRUE(eventually(receiver, [&] {
    while (const auto one = all.pop()) seqs.push_back(one->stamp.seq);
    return !seqs.empty() && seqs.back() == 9;
  }));
  EXPECT_THAT(seqs, ::testing::ElementsAre(3, 3, 1, 2, 3, 9));
}

TEST_F(NodeTest, WaitEndsAtItsDeadline) {
  Node node(options());
  const std::int64_t begin_us = node.utime_us();
  EXPECT_FALSE(node.wait_for_input(begin_us + 20'000));
  EXPECT_GE(node.utime_us(), begin_us + 20'000);
  EXPECT_FALSE(node.wait_for_input(begin_us));  // already over: does not wait
}

TEST_F(NodeTest, StopRequestEndsTheWait) {
  install_stop_signals();
  clear_stop_request();
  Node node(options());
  std::thread stopper([] { request_stop(); });
  while (!stop_requested()) node.wait_for_input(node.utime_us() + kLong_us);
  stopper.join();
  EXPECT_TRUE(node.wait_for_input(node.utime_us() + kLong_us));
  clear_stop_request();
}

TEST_F(NodeTest, EventCanBePolledBesideOtherDescriptors) {
  Node receiver(options());
  receiver.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(receiver);
  Node sender(options());
  sender.publisher<LegCommand>(channels::kLegCommand).publish(command(0));
  pollfd wait{receiver.event_fd(), POLLIN, 0};
  EXPECT_EQ(poll(&wait, 1, 20'000), 1);
  receiver.clear_event();
  EXPECT_EQ(poll(&wait, 1, 0), 0);
}

TEST_F(NodeTest, TimeBeginsAtTheEpoch) {
  NodeOptions with_epoch = options();
  with_epoch.epoch_us = monotonic_us() - 1'000'000;
  const Node node(with_epoch);
  const std::int64_t earliest_us = monotonic_us() - with_epoch.epoch_us;
  const std::int64_t utime_us = node.utime_us();
  EXPECT_GE(utime_us, earliest_us);
  EXPECT_LE(utime_us, monotonic_us() - with_epoch.epoch_us);
  EXPECT_GE(utime_us, 1'000'000);
  constexpr std::int64_t kCut_us = 2;  // clocks are cut to whole microseconds
  const std::int64_t utc_before_us = utc_us();
  const std::int64_t offset_us = node.clock().utc_offset_us();
  const std::int64_t utime_after_us = node.utime_us();
  EXPECT_GE(offset_us, utc_before_us - utime_after_us - kCut_us);
  EXPECT_LE(offset_us, utc_us() - utime_us + kCut_us);
}

TEST_F(NodeTest, RefusesABadNetworkAndABadInjection) {
  NodeOptions bad = options();
  bad.lcm_url = "nonsense://";
  EXPECT_THROW(Node{bad}, std::invalid_argument);
  EXPECT_THROW(Node{options({"drop"})}, std::invalid_argument);
}

TEST_F(NodeTest, SubscribingAfterStartIsAMistake) {
  Node node(options());
  node.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_);
  const Receiving receiving(node);
  EXPECT_THROW(node.subscribe(channels::kLegCommand, CountLimits::exactly(1), slot_), std::logic_error);
}

}  // namespace
}  // namespace sprung
