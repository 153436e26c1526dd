/// Estimator, planner and leg controller around a bridge, on a network that loses messages, in virtual time:
/// whatever is lost, every cycle is answered once, in order, from the same inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "runtime/answer_store.h"
#include "runtime/responder.h"
#include "signals/stamp.h"

namespace sprung {
namespace {

struct Signal {
  Stamp stamp;
  std::uint64_t content = 0;  ///< hash of all that it rests on
};

std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  return (a ^ (b + 0x9e3779b97f4a7c15U)) * 0xbf58476d1ce4e5b9U;
}

/// One process: slots, responder and stored answers as in the real ones, with a hash for a core.
class RingProcess {
 public:
  RingProcess(bool has_partner, std::function<void(const Signal&)> send)
      : has_partner_(has_partner), send_(std::move(send)), responder_(timing(has_partner)) {}

  void turn(std::int64_t now_us) {
    for (;;) {
      const auto decision = responder_.decide(
          {inputs.held(), partners.held(), inputs.take_repeated(), now_us});
      if (decision.action == ResponderAction::kWait) return;
      if (decision.action == ResponderAction::kStep) step(decision.seq);
      if (decision.action == ResponderAction::kResend) resend(decision.seq);
    }
  }

  Slot<Signal> inputs{Signal{}};
  Slot<Signal> partners{Signal{}};
  std::vector<Signal> answered;
  const ResponderCounters& counters() const { return responder_.counters(); }

 private:
  static LockstepTiming timing(bool has_partner) {
    LockstepTiming timing;
    timing.has_partner = has_partner;
    return timing;
  }
  void step(std::int64_t seq) {
    Signal in;
    Signal partner;
    ASSERT_TRUE(inputs.get(seq, in));
    state_ = mix(state_, in.content);
    if (has_partner_ && partners.newest_at_or_before(seq - 1, partner)) state_ = mix(state_, partner.content);
    const Signal out{in.stamp, state_};
    answered.push_back(out);
    store_.keep(out);
    send_(out);
  }
  void resend(std::int64_t seq) {
    for (const std::int64_t stored : {seq - 1, seq}) {
      if (const Signal* answer = store_.find(stored)) send_(*answer);
    }
  }

  bool has_partner_;
  std::function<void(const Signal&)> send_;
  LockstepResponder responder_;
  AnswerStore<Signal> store_{Signal{}};
  std::uint64_t state_ = 1;
};

class Ring {
 public:
  /// @param loss share of the messages that the network loses.
  Ring(double loss, unsigned seed) : loss_(loss), random_(seed) {}

  /// Bridge: next cycle when DRIVE_COMMAND(k) is in, DRIVE_STATE(k) again after 50 ms, next cycle anyway
  /// after 1 s.
  void run(std::int64_t cycles) {
    for (std::int64_t k = 0; k < cycles; ++k) {
      const std::int64_t began_us = now_us_;
      std::uint64_t answer = 0;
      do {
        send_drive_state({{k * 1000, k}, mix(fed_back_, static_cast<std::uint64_t>(k))});
        for (const std::int64_t end_us = now_us_ + 50'000; now_us_ < end_us && !command_of(k, answer);) {
          now_us_ += 100;
          turn_all();
        }
      } while (!command_of(k, answer) && now_us_ - began_us < 1'000'000);
      if (!command_of(k, answer)) ++given_up;
      fed_back_ = answer;
    }
  }

  RingProcess estimator{false,
                        [this](const Signal& s) { send(planner.inputs, s), send(controller.inputs, s); }};
  RingProcess planner{false, [this](const Signal& s) { send(controller.partners, s); }};
  RingProcess controller{true, [this](const Signal& s) { send(commands_, s); }};
  bool planner_lives = true;
  int given_up = 0;
  int lost = 0;

 private:
  void send(Slot<Signal>& to, const Signal& signal) {
    if (std::uniform_real_distribution<>(0, 1)(random_) < loss_) {
      ++lost;
    } else {
      to.push(signal);
    }
  }
  void send_drive_state(const Signal& signal) { send(estimator.inputs, signal); }
  bool command_of(std::int64_t seq, std::uint64_t& content) {
    Signal command;
    if (!commands_.get(seq, command)) return false;
    content = command.content;
    return true;
  }
  void turn_all() {
    std::vector<RingProcess*> order{&estimator, &planner, &controller};
    std::shuffle(order.begin(), order.end(), random_);  // who is scheduled first must not matter
    for (RingProcess* process : order) {
      if (process != &planner || planner_lives) process->turn(now_us_);
    }
  }

  double loss_;
  std::mt19937 random_;
  std::int64_t now_us_ = 0;
  std::uint64_t fed_back_ = 0;
  Slot<Signal> commands_{Signal{}};
};

std::vector<std::uint64_t> contents(const RingProcess& process) {
  std::vector<std::uint64_t> result;
  for (const Signal& signal : process.answered) result.push_back(signal.content);
  return result;
}

void expect_in_order(const RingProcess& process, std::size_t cycles) {
  ASSERT_GE(process.answered.size(), cycles);
  for (std::size_t i = 0; i < process.answered.size(); ++i) {
    ASSERT_EQ(process.answered[i].stamp.seq, static_cast<std::int64_t>(i));
  }
}

TEST(ResponderRing, LostMessagesChangeNothing) {
  constexpr std::int64_t kCycles = 400;
  Ring good(0.0, 1);
  good.run(kCycles);
  ASSERT_EQ(good.lost, 0);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Ring ring(0.05, seed);
    ring.run(kCycles);
    EXPECT_GT(ring.lost, 10);
    EXPECT_EQ(ring.given_up, 0);
    EXPECT_EQ(ring.controller.counters().missed_partners, 0) << "seed " << seed;
    for (const RingProcess* process : {&ring.estimator, &ring.planner, &ring.controller}) {
      EXPECT_EQ(process->counters().skipped_inputs, 0) << "seed " << seed;
    }
    expect_in_order(ring.controller, kCycles);
    EXPECT_EQ(contents(ring.controller), contents(good.controller)) << "seed " << seed;
    EXPECT_EQ(contents(ring.estimator), contents(good.estimator)) << "seed " << seed;
  }
}

TEST(ResponderRing, ManyLossesAtOnceAreRepaired) {
  // So many losses hit every message of the ring, several at once, and repairs themselves.
  for (unsigned seed = 0; seed < 10; ++seed) {
    Ring ring(0.15, seed);
    ring.run(100);
    EXPECT_EQ(ring.given_up, 0) << "seed " << seed;
    expect_in_order(ring.estimator, 100);
  }
}

TEST(ResponderRing, DeadPlannerDoesNotStopTheCycle) {
  Ring dead(0.0, 3);
  dead.planner_lives = false;
  dead.run(50);
  EXPECT_EQ(dead.given_up, 0);
  EXPECT_EQ(dead.controller.counters().missed_partners, 49);  // cycle 0 needs none
  expect_in_order(dead.controller, 50);
}

}  // namespace
}  // namespace sprung
