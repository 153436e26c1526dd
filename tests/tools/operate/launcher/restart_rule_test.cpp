#include "tools/operate/launcher/restart_rule.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr std::int64_t kEnd_us = 10'000'000;
constexpr std::int64_t kLater_us = kEnd_us + 2'000'000;
const TorqueHeard kOff{false, kLater_us};

EndedProcess restart_rule_planner() { return {RestartPolicy::kWithoutTorque, false, false, 0, kEnd_us}; }

TEST(RestartRule, WithoutTorqueItIsDue) {
  EXPECT_TRUE(RestartRule::due(restart_rule_planner(), kOff, kLater_us));
}

TEST(RestartRule, NotWhileAnyDriveMayHaveTorque) {
  EXPECT_FALSE(RestartRule::due(restart_rule_planner(), TorqueHeard{true, kLater_us}, kLater_us));
}

TEST(RestartRule, SilentBridgeIsNoProof) {
  EXPECT_FALSE(RestartRule::due(restart_rule_planner(), std::nullopt, kLater_us));
  EXPECT_FALSE(RestartRule::due(restart_rule_planner(), kOff, kLater_us + RestartRule::kFresh_us + 1));
}

TEST(RestartRule, WhatTheBridgeSaidBeforeTheEndIsNoProof) {
  const TorqueHeard before{false, kEnd_us + RestartRule::kSettle_us - 1};
  EXPECT_FALSE(RestartRule::due(restart_rule_planner(), before, kEnd_us + RestartRule::kSettle_us));
}

TEST(RestartRule, NeverMeansNever) {
  EndedProcess bridge = restart_rule_planner();
  bridge.policy = RestartPolicy::kNever;
  EXPECT_FALSE(RestartRule::due(bridge, kOff, kLater_us));
  EXPECT_FALSE(RestartRule::hopeful(bridge));
}

TEST(RestartRule, LockStepIsNotDeterministicAfterARestart) {
  EndedProcess ended = restart_rule_planner();
  ended.lockstep = true;
  EXPECT_FALSE(RestartRule::hopeful(ended));
}

TEST(RestartRule, RecorderNeedsNobodysLeave) {
  EndedProcess recorder;
  recorder.harmless = recorder.by_signal = true;
  recorder.lockstep = true;
  EXPECT_TRUE(RestartRule::due(recorder, std::nullopt, kEnd_us));
}

/// It would find the disk as full as the one before did.
TEST(RestartRule, RecorderThatEndedByItselfStaysEnded) {
  EndedProcess recorder;
  recorder.harmless = true;
  EXPECT_FALSE(RestartRule::hopeful(recorder));
  EXPECT_FALSE(RestartRule::due(recorder, std::nullopt, kEnd_us));
}

TEST(RestartRule, WhatDiesAgainAndAgainStaysDead) {
  EndedProcess ended = restart_rule_planner();
  ended.restarts = RestartRule::kMost;
  EXPECT_FALSE(RestartRule::due(ended, kOff, kLater_us));
  ended.harmless = ended.by_signal = true;
  EXPECT_FALSE(RestartRule::due(ended, kOff, kLater_us));
}

}  // namespace
}  // namespace sprung
