#include "tools/operate/client/operator_client.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <thread>

#include "lcmtypes/channels.h"
#include "tests/runtime/lcm_network.h"

namespace sprung {
namespace {

constexpr std::int64_t kSession = 77;
constexpr double kLong_s = 20.0;

/// A robot that answers as it is told to, in a thread of its own.
class ToldRobot {
 public:
  /// @param answer to a command: nothing is an answer that was lost.
  ToldRobot(const NodeOptions& options,
            std::function<std::optional<OperatorOutcome>(const sprung_msgs::operator_command_t&)> answer)
      : node_(options),
        replies_(node_.publisher<OperatorReply>(channels::kOperatorReply)),
        answer_(std::move(answer)) {
    node_.subscribe_message(channels::kOperatorCommand, CountLimits::none(), commands_);
    node_.start();
    thread_ = std::thread([this] { run(); });
  }
  ~ToldRobot() { end(); }
  /// What it has counted may be read from now on.
  void end() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void run() {
    while (!ended_) {
      while (const auto command = commands_.pop()) {
        const std::optional<OperatorOutcome> outcome = answer_(*command);
        if (!outcome) continue;
        OperatorReply reply;
        reply.request_id = command->request_id;
        reply.outcome = *outcome;
        replies_.publish(reply);
      }
      node_.wait_for_input(node_.utime_us() + 10'000);
    }
  }

  InputQueue<sprung_msgs::operator_command_t> commands_{256};
  Node node_;
  Publisher<OperatorReply> replies_;
  std::function<std::optional<OperatorOutcome>(const sprung_msgs::operator_command_t&)> answer_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

class OperatorClientTest : public ::testing::Test {
 protected:
  NodeOptions robot() const { return {url_, kSession, 0, {}}; }
  static OperatorCommand hold() {
    OperatorCommand out;
    out.kind = OperatorKind::kHold;
    out.hold_s = 0.5;
    return out;
  }
  const std::string url_ = test::own_lcm_url();
};

TEST_F(OperatorClientTest, SaysTheSameAgainUntilItIsAnswered) {
  std::multiset<std::int64_t> heard;
  ToldRobot told(robot(), [&](const auto& command) -> std::optional<OperatorOutcome> {
    heard.insert(command.request_id);
    if (heard.size() < 3) return std::nullopt;
    return OperatorOutcome::kAccepted;
  });
  OperatorClient client(robot());
  OperatorCommand command = hold();
  const auto answer = client.send(command, kLong_s);
  told.end();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, OperatorOutcome::kAccepted);
  EXPECT_GE(heard.count(command.request_id), 3u);
}

TEST_F(OperatorClientTest, RenewsThoughNobodyAnswers) {
  std::set<std::int64_t> heard;
  ToldRobot told(robot(), [&](const auto& command) -> std::optional<OperatorOutcome> {
    heard.insert(command.request_id);
    if (heard.size() < 6) return std::nullopt;
    return OperatorOutcome::kRefused;
  });
  OperatorClient client(robot());
  client.renew(hold(), 0.02);
  const auto answer = client.wait_refused(kLong_s);
  told.end();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, OperatorOutcome::kRefused);
  EXPECT_GE(heard.size(), 6u) << "each with an id of its own";
}

TEST_F(OperatorClientTest, RenewsWhileItWaitsForADoneThatIsLost) {
  std::int64_t of_walk = 0;
  int renewals = 0;
  ToldRobot told(robot(), [&](const auto& command) -> std::optional<OperatorOutcome> {
    if (command.kind == static_cast<int>(OperatorKind::kHold)) {
      ++renewals;
      return OperatorOutcome::kDone;
    }
    if (of_walk == 0) {
      of_walk = command.request_id;
      return OperatorOutcome::kAccepted;
    }
    return renewals < 5 ? std::nullopt : std::optional(OperatorOutcome::kDone);
  });
  OperatorClient client(robot());
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  ASSERT_TRUE(client.send(walk, kLong_s));
  client.renew(hold(), 0.02);
  const auto done = client.wait_done(walk, kLong_s);
  told.end();
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, OperatorOutcome::kDone);
  EXPECT_GE(renewals, 5);
}

TEST_F(OperatorClientTest, RefusalOfSomebodyElsesCommandDoesNotEndAHold) {
  std::atomic<bool> refuses{true};
  std::atomic<int> heard{0};
  ToldRobot told(robot(), [&](const auto&) -> std::optional<OperatorOutcome> {
    if (refuses) return OperatorOutcome::kRefused;
    return ++heard < 4 ? OperatorOutcome::kDone : OperatorOutcome::kRefused;
  });
  OperatorClient other(robot());
  OperatorClient client(robot());
  OperatorCommand elses = hold();
  ASSERT_EQ(other.send(elses, kLong_s)->outcome, OperatorOutcome::kRefused);  // `client` hears it too
  refuses = false;
  client.renew(hold(), 0.02);
  ASSERT_TRUE(client.wait_refused(kLong_s));
  EXPECT_GE(heard, 4);
}

TEST_F(OperatorClientTest, NobodyThereIsSaid) {
  OperatorClient client(robot());
  client.renew(hold(), 0.02);
  EXPECT_FALSE(client.wait_refused(0.2));
}

}  // namespace
}  // namespace sprung
