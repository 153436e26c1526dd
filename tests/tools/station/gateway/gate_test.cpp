#include "tools/station/gateway/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "lcmtypes/channels.h"
#include "tests/tools/station/gateway/gateway_sample.h"

namespace sprung::gateway {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kNow_us = 1'000'000'000;

class GateTest : public testing::Test {
 protected:
  GateTest() {
    gate_.robot_is_up(kSampleRun, kNow_us - 5'000'000);
    for (auto* one : {&alice_, &bob_, &watcher_}) EXPECT_TRUE(one->welcomed(take(one->hello())));
    for (auto* one : {&alice_, &bob_, &watcher_}) take(one->says(SaidKind::kAlive, "", now_us_));
  }
  Verdict take(const std::string& packet) { return gate_.take("here", packet, now_us_, ++session_); }
  Verdict says(SampleOperator& who, OperatorKind kind) { return take(who.says(kind, now_us_)); }
  /// Time passes; `who` is heard fifty times a second.
  void pass(double seconds, std::vector<SampleOperator*> who) {
    const std::int64_t end_us = now_us_ + static_cast<std::int64_t>(1e6 * seconds);
    while ((now_us_ += 20'000) < end_us)
      for (SampleOperator* one : who) take(one->says(SaidKind::kAlive, "", now_us_));
  }
  static KnownOperator known(const std::string& name, std::uint8_t number, Role role) {
    return {name, key_of_number(number).public_key(), role, "2026-11-27", ""};
  }

  std::int64_t now_us_ = kNow_us;
  std::uint64_t session_ = 100;
  SigningKey robot_ = key_of_number(9);
  std::vector<KnownOperator> register_{known("alice", 1, Role::kDrive), known("bob", 2, Role::kMaintain),
                                       known("watcher", 3, Role::kWatch)};
  Gate gate_{robot_, register_};
  SampleOperator alice_{1, robot_.public_key()}, bob_{2, robot_.public_key()},
      watcher_{3, robot_.public_key()}, stranger_{4, robot_.public_key()};
};

TEST_F(GateTest, ACommandOfTheDriverGoesToTheRobotAndIsNotedOnce) {
  const std::string text = encoded_command(command_of(OperatorKind::kStand, 77));
  const Verdict first = take(alice_.says(SaidKind::kCommand, text, now_us_));
  ASSERT_TRUE(first.command);
  EXPECT_EQ(first.command->kind, OperatorKind::kStand);
  EXPECT_EQ(first.command->request_id, 77);
  EXPECT_THAT(first.event, HasSubstr("stand"));
  const Verdict again = take(alice_.says(SaidKind::kCommand, text, now_us_));
  EXPECT_TRUE(again.command);
  EXPECT_EQ(again.event, "");
}

TEST_F(GateTest, AStrangersHelloIsNotAnswered) {
  const Verdict out = take(stranger_.hello());
  EXPECT_EQ(out.turned, Turned::kUnknown);
  EXPECT_TRUE(out.packets.empty());
  EXPECT_EQ(out.who, "") << "whoever floods with keys that he makes up fills no log with them";
}

TEST_F(GateTest, AHelloForAnotherRobotIsForged) {
  SampleOperator lost(1, key_of_number(8).public_key());
  EXPECT_EQ(take(lost.hello()).turned, Turned::kForged);
}

TEST_F(GateTest, AHelloThatComesAgainOpensNoSecondConversation) {
  SampleOperator again(1, robot_.public_key());
  const std::string hello = again.hello();
  const Verdict first = take(hello), second = take(hello);
  ASSERT_FALSE(first.packets.empty());
  EXPECT_EQ(first.packets, second.packets);
}

TEST_F(GateTest, NothingComesInTwice) {
  const std::string packet = alice_.says(OperatorKind::kStand, now_us_);
  EXPECT_TRUE(take(packet).command);
  for (int k = 0; k < 3; ++k) {
    const Verdict again = take(packet);
    EXPECT_EQ(again.turned, Turned::kReplayed);
    EXPECT_FALSE(again.command);
  }
}

TEST_F(GateTest, WhatIsLateOrEarlyDoesNotCount) {
  EXPECT_EQ(take(alice_.says(OperatorKind::kStand, now_us_ - Gate::kOldest_us - 1)).turned, Turned::kLate);
  EXPECT_EQ(take(alice_.says(OperatorKind::kStand, now_us_ + Gate::kMostAhead_us + 1)).turned, Turned::kLate);
  EXPECT_TRUE(take(alice_.says(OperatorKind::kStand, now_us_ - Gate::kOldest_us)).command);
}

TEST_F(GateTest, ATimeThatOverflowsIsLate) {
  for (const std::int64_t time_us :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(take(alice_.says(OperatorKind::kStand, time_us)).turned, Turned::kLate);
}

TEST_F(GateTest, OneBitElsewhereIsForgedOrWorse) {
  const std::string packet = alice_.says(OperatorKind::kStand, now_us_);
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    std::string other = packet;
    other[random() % other.size()] ^= static_cast<char>(1 << random() % 8);
    const Verdict out = take(other);
    EXPECT_NE(out.turned, Turned::kNone);
    EXPECT_FALSE(out.command);
  }
  EXPECT_TRUE(take(packet).command) << "what was forged in her name does not use up her numbers";
}

TEST_F(GateTest, AnothersSignatureInMyConversationIsForged) {
  SampleOperator thief(2, robot_.public_key());
  thief.session = alice_.session;
  thief.number = 1000;
  EXPECT_EQ(says(thief, OperatorKind::kStand).turned, Turned::kForged);
}

TEST_F(GateTest, ARoleBoundsWhatMayBeSaidAndTheOperatorIsToldWhy) {
  const Verdict out = says(watcher_, OperatorKind::kWalk);
  EXPECT_EQ(out.turned, Turned::kRole);
  ASSERT_EQ(out.packets.size(), 1u);
  const auto told = watcher_.hears(out.packets[0].second);
  ASSERT_TRUE(told);
  EXPECT_THAT(told->text, HasSubstr(channels::kOperatorReply));
  EXPECT_THAT(told->text, HasSubstr("watcher's key is to watch"));
  EXPECT_EQ(says(alice_, OperatorKind::kHome).turned, Turned::kRole);
  EXPECT_TRUE(says(watcher_, OperatorKind::kEstop).command) << "everybody may stop it";
  EXPECT_EQ(says(watcher_, OperatorKind::kStop).turned, Turned::kRole);
}

/// Said every 20 ms until it is answered, over a network that is 150 ms late.
TEST_F(GateTest, ACopyOfAnEmergencyStopThatComesAfterTheClearStopsNothing) {
  const std::string stop = encoded_command(command_of(OperatorKind::kEstop, 7));
  const auto said = [&](const std::string& text) {
    return take(alice_.says(SaidKind::kCommand, text, now_us_)).command.has_value();
  };
  EXPECT_TRUE(said(stop));
  EXPECT_TRUE(said(stop)) << "the robot may not have heard the first one";
  EXPECT_TRUE(said(encoded_command(command_of(OperatorKind::kClear, 8))));
  EXPECT_FALSE(said(stop));
  EXPECT_TRUE(said(encoded_command(command_of(OperatorKind::kEstop, 9)))) << "a new one does";
  for (std::int64_t id = 10; id < 100; ++id) {
    EXPECT_TRUE(said(encoded_command(command_of(OperatorKind::kEstop, id))));
    EXPECT_TRUE(said(encoded_command(command_of(OperatorKind::kClear, 1000 + id))));
  }
  EXPECT_FALSE(said(encoded_command(command_of(OperatorKind::kEstop, 99))));
}

/// Of those that it has forgotten, a robot executes none that is not newer: one with a huge id would lock all
/// others out.
TEST_F(GateTest, ARequestOfNextWeekIsMalformed) {
  const auto let_in = [&](std::int64_t id) {
    const std::string text = encoded_command(command_of(OperatorKind::kEstop, id));
    return take(alice_.says(SaidKind::kCommand, text, now_us_)).turned;
  };
  EXPECT_EQ(let_in(request_id_at(5'100'000)), Turned::kNone);
  EXPECT_EQ(let_in(request_id_at(5'000'000 + 604'800'000'000)), Turned::kMalformed);
  EXPECT_EQ(let_in(std::numeric_limits<std::int64_t>::max()), Turned::kMalformed);
}

TEST_F(GateTest, ACommandForAnotherRunIsRefusedAndAnEmergencyStopIsNot) {
  gate_.robot_is_up(kSampleRun + 1, now_us_ - 5'000'000);
  const Verdict out = says(alice_, OperatorKind::kStand);
  EXPECT_EQ(out.turned, Turned::kOtherRun);
  EXPECT_THAT(alice_.hears(out.packets.at(0).second)->text, HasSubstr("started anew"));
  EXPECT_TRUE(says(alice_, OperatorKind::kEstop).command);
  gate_.robot_is_down();
  const Verdict down = says(alice_, OperatorKind::kEstop);
  EXPECT_EQ(down.turned, Turned::kOtherRun);
  EXPECT_THAT(alice_.hears(down.packets.at(0).second)->text, HasSubstr("no robot is up"));
  EXPECT_EQ(gate_.driver(), "");
}

TEST_F(GateTest, ACommandThatAsksForNothingMakesNobodyDrive) {
  EXPECT_EQ(says(watcher_, OperatorKind::kNone).turned, Turned::kMalformed);
  EXPECT_EQ(gate_.driver(), "");
}

TEST_F(GateTest, WhatMovesGoesWithTheWheel) {
  says(alice_, OperatorKind::kWalk);
  take(alice_.says(SaidKind::kHandOver, "bob", now_us_));
  pass(1.0, {&bob_});
  EXPECT_FALSE(gate_.link_is_lost(true, now_us_)) << "bob is there";
  pass(1.0, {&alice_});
  EXPECT_TRUE(gate_.link_is_lost(true, now_us_)) << "alice does not drive any more";
}

TEST_F(GateTest, EveryKindOfCommandHasARole) {
  for (const auto& word : kWords<OperatorKind>) {
    const bool harmless = word.value == OperatorKind::kEstop || word.value == OperatorKind::kNone ||
                          word.value == OperatorKind::kReadParameter;
    EXPECT_EQ(role_for(word.value) == Role::kWatch, harmless) << word.name;
  }
}

TEST_F(GateTest, WhoAsksForAParameterDoesNotDriveAndWhoSetsOneMaintains) {
  EXPECT_TRUE(says(alice_, OperatorKind::kReadParameter).command);
  EXPECT_EQ(gate_.driver(), "");
  EXPECT_EQ(says(alice_, OperatorKind::kSetParameter).turned, Turned::kRole);
}

TEST_F(GateTest, WhoDrivesKeepsTheRobotUntilHeHandsItOver) {
  EXPECT_TRUE(says(alice_, OperatorKind::kStand).command);
  EXPECT_EQ(gate_.driver(), "alice");
  const Verdict out = says(bob_, OperatorKind::kWalk);
  EXPECT_EQ(out.turned, Turned::kNotDriver);
  EXPECT_THAT(bob_.hears(out.packets.at(0).second)->text, HasSubstr("alice drives"));
  EXPECT_TRUE(says(bob_, OperatorKind::kStop).command) << "stopping is everybody's who may drive";
  EXPECT_EQ(take(bob_.says(SaidKind::kHandOver, "bob", now_us_)).turned, Turned::kNotDriver);
  EXPECT_EQ(take(alice_.says(SaidKind::kHandOver, "watcher", now_us_)).turned, Turned::kRole);
  EXPECT_EQ(take(alice_.says(SaidKind::kHandOver, "bob", now_us_)).turned, Turned::kNone);
  EXPECT_TRUE(says(bob_, OperatorKind::kWalk).command);
  EXPECT_EQ(says(alice_, OperatorKind::kWalk).turned, Turned::kNotDriver);
}

TEST_F(GateTest, SteppingBetweenCommandsKeepsTheWheelForTenSeconds) {
  says(alice_, OperatorKind::kStand);
  take(alice_.says(SaidKind::kBye, "", now_us_));
  pass(8.0, {&bob_});
  EXPECT_TRUE(gate_.tidy(false, now_us_).empty());
  EXPECT_EQ(says(bob_, OperatorKind::kWalk).turned, Turned::kNotDriver);
  pass(3.0, {&bob_});
  EXPECT_THAT(gate_.tidy(true, now_us_), testing::IsEmpty()) << "not while the robot moves";
  EXPECT_THAT(gate_.tidy(false, now_us_), testing::ElementsAre("alice"));
  EXPECT_TRUE(says(bob_, OperatorKind::kWalk).command);
}

TEST_F(GateTest, ALinkThatIsLostWhileTheRobotMovesIsSeenInLessThanASecond) {
  says(alice_, OperatorKind::kWalk);
  pass(2.0, {&alice_, &bob_});
  EXPECT_FALSE(gate_.link_is_lost(true, now_us_));
  pass(0.2, {&bob_});
  EXPECT_FALSE(gate_.link_is_lost(true, now_us_));
  pass(0.3, {&bob_});
  EXPECT_TRUE(gate_.link_is_lost(true, now_us_));
  EXPECT_FALSE(gate_.link_is_lost(false, now_us_));
}

TEST_F(GateTest, WhoSaysGoodbyeInAMotionThatGoesOnHasLeftIt) {
  says(alice_, OperatorKind::kWalk);
  take(alice_.says(SaidKind::kBye, "", now_us_));
  EXPECT_TRUE(gate_.link_is_lost(true, now_us_));
}

TEST_F(GateTest, WhatEndsByItselfNeedsNobodyAfterAGoodbyeButALostLinkEndsItToo) {
  OperatorCommand walk = command_of(OperatorKind::kWalk);
  walk.hold_s = 5.0;
  take(alice_.says(SaidKind::kCommand, encoded_command(walk), now_us_));
  pass(1.0, {&bob_});
  EXPECT_TRUE(gate_.link_is_lost(true, now_us_));
  take(alice_.says(SaidKind::kBye, "", now_us_));
  EXPECT_FALSE(gate_.link_is_lost(true, now_us_));
}

/// Somebody at the robot itself walks it later: his link is none of ours.
TEST_F(GateTest, WhatAlicesCommandDoesNotMoveAnyMoreIsNotHers) {
  says(alice_, OperatorKind::kWalk);
  pass(5.0, {&alice_});
  EXPECT_FALSE(gate_.link_is_lost(false, now_us_));
  pass(5.0, {});
  EXPECT_FALSE(gate_.link_is_lost(true, now_us_));
}

TEST_F(GateTest, ARevokedKeyIsOutAtOnceAndToldSo) {
  says(alice_, OperatorKind::kStand);
  register_[0].revoked = "2026-11-28";
  gate_.know(register_);
  EXPECT_EQ(says(alice_, OperatorKind::kWalk).turned, Turned::kRevoked);
  EXPECT_EQ(gate_.driver(), "");
  SampleOperator again(1, robot_.public_key());
  const Verdict out = take(again.hello());
  EXPECT_EQ(out.turned, Turned::kRevoked);
  const auto welcome = read_welcome(out.packets.at(0).second, robot_.public_key(), again.key().public_key());
  ASSERT_TRUE(welcome);
  EXPECT_THAT(welcome->refusal, HasSubstr("revoked on 2026-11-28"));
  gate_.tidy(false, now_us_);
  EXPECT_EQ(gate_.sessions().size(), 2u);
}

TEST_F(GateTest, AKeyThatWasTakenOffTheRegisterIsOutToo) {
  gate_.know({});
  EXPECT_EQ(says(alice_, OperatorKind::kEstop).turned, Turned::kRevoked);
}

TEST_F(GateTest, TooManyAreTurnedAwayButNoEmergencyStopIs) {
  int let_in = 0;
  for (int k = 0; k < 3000; ++k) let_in += says(alice_, OperatorKind::kStand).command ? 1 : 0;
  EXPECT_LE(let_in, Gate::kMostEachSecond);
  EXPECT_EQ(says(alice_, OperatorKind::kStand).turned, Turned::kTooMany);
  EXPECT_TRUE(says(alice_, OperatorKind::kEstop).command);
  EXPECT_GT(gate_.counts().at(Turned::kTooMany), 2000);
}

TEST_F(GateTest, HellosAreBounded) {
  int answered = 0;
  for (int k = 0; k < 1000; ++k) {
    SampleOperator one(1, robot_.public_key());
    answered += take(one.hello()).packets.empty() ? 0 : 1;
  }
  EXPECT_LE(answered, 40);
}

TEST_F(GateTest, SilentConversationsMakeRoomBeforeThoseThatSpoke) {
  for (int k = 0; k < 100; ++k) {
    now_us_ += 1'000'000;
    SampleOperator one(1, robot_.public_key());
    std::string hello = one.hello();
    take(hello);
    for (auto* who : {&alice_, &bob_, &watcher_}) take(who->says(SaidKind::kAlive, "", now_us_));
  }
  EXPECT_EQ(gate_.sessions().size(), 3u);
}

TEST_F(GateTest, WhatTheRobotSaysIsSealedForEachAndHiddenWhereThatWasAsked) {
  SampleOperator secret(2, robot_.public_key(), true);
  ASSERT_TRUE(secret.welcomed(take(secret.hello())));
  const auto open = gate_.tell(alice_.session, ToldKind::kNews, "the robot walks", now_us_);
  const auto hidden = gate_.tell(secret.session, ToldKind::kNews, "the robot walks", now_us_);
  ASSERT_TRUE(open && hidden);
  EXPECT_THAT(open->second, HasSubstr("the robot walks"));
  EXPECT_THAT(hidden->second, testing::Not(HasSubstr("walks")));
  EXPECT_EQ(alice_.hears(open->second)->text, "the robot walks");
  EXPECT_EQ(secret.hears(hidden->second)->text, "the robot walks");
  EXPECT_FALSE(bob_.hears(open->second));
  EXPECT_FALSE(gate_.tell(4711, ToldKind::kNews, "", now_us_));
}

TEST_F(GateTest, EverySecondOperatorSeesWhoDrives) {
  says(alice_, OperatorKind::kStand);
  EXPECT_EQ(gate_.news(bob_.session), R"({"driver":"alice","you":"bob","role":"maintain"})");
}

TEST_F(GateTest, AnyBytesAreTurnedAway) {
  std::mt19937 random(2);
  for (int k = 0; k < 3000; ++k) {
    std::string packet = "SPG1" + std::string(1, static_cast<char>(random() % 6));
    packet.resize(5 + random() % 400);
    for (std::size_t i = 5; i < packet.size(); ++i) packet[i] = static_cast<char>(random());
    packet.resize(random() % (packet.size() + 1));
    EXPECT_NE(take(packet).turned, Turned::kNone);
  }
}

TEST_F(GateTest, ACommandThatIsNoneIsMalformed) {
  std::string text = encoded_command(command_of(OperatorKind::kStand));
  EXPECT_EQ(take(alice_.says(SaidKind::kCommand, text + "x", now_us_)).turned, Turned::kMalformed);
  text[0] ^= 1;  // of the type's hash
  EXPECT_EQ(take(alice_.says(SaidKind::kCommand, text, now_us_)).turned, Turned::kMalformed);
  EXPECT_EQ(take(alice_.says(SaidKind::kCommand, "", now_us_)).turned, Turned::kMalformed);
  OperatorCommand odd = command_of(static_cast<OperatorKind>(120));
  EXPECT_EQ(take(alice_.says(SaidKind::kCommand, encoded_command(odd), now_us_)).turned, Turned::kMalformed);
}

TEST_F(GateTest, OfAHundredThousandForgedReplayedAndLateCommandsNoneIsLetIn) {
  const std::string good = alice_.says(OperatorKind::kStand, now_us_);
  ASSERT_TRUE(take(good).command);
  SampleOperator thief(4, robot_.public_key());
  thief.session = alice_.session;
  thief.number = 1'000'000;
  const std::string forged = thief.says(OperatorKind::kWalk, now_us_);
  std::mt19937 random(3);
  std::int64_t let_in = 0;
  for (int k = 0; k < 100'000; ++k) {
    std::string packet = good;  // replayed
    if (k % 3 == 1)
      packet[random() % (packet.size() - 64)] ^= static_cast<char>(1 << random() % 8);  // forged
    if (k % 3 == 2 && k % 30 != 2) packet = forged;
    if (k % 30 == 2) packet = alice_.says(OperatorKind::kWalk, now_us_ - 2 * Gate::kOldest_us);  // late
    const Verdict out = take(packet);
    let_in += out.command || out.turned == Turned::kNone ? 1 : 0;
  }
  EXPECT_EQ(let_in, 0);
}

}  // namespace
}  // namespace sprung::gateway
