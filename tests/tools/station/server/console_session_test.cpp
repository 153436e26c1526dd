#include "tools/station/server/console_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "robots/parameters.h"
#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Console : public testing::Test {
 protected:
  static constexpr std::int64_t kTick_us = 20'000;

  void open(int page) {
    session_.page_opened(page, now_us_);
    say(page, {{"type", "alive"}});
  }
  void step() {
    const Outbox out = session_.step(now_us_);
    for (const OperatorCommand& command : out.commands)
      (command.kind == OperatorKind::kReadParameter ? reads_ : commands_).push_back(command);
    for (const auto& [page, text] : out.texts) told_[page].push_back(Json::parse(text));
    closed_.insert(closed_.end(), out.close.begin(), out.close.end());
  }
  void say(int page, const Json& message) {
    session_.text(page, message.dump(), now_us_);
    step();
  }
  /// @param every called each tick
  void go_on(
      double seconds, const std::function<void()>& every = [] {}) {
    const auto end_us = now_us_ + static_cast<std::int64_t>(1e6 * seconds);
    while ((now_us_ += kTick_us) <= end_us) {
      every();
      step();
    }
  }
  int said(OperatorKind kind) const {
    std::set<std::int64_t> ids;
    for (const OperatorCommand& command : commands_)
      if (command.kind == kind) ids.insert(command.request_id);
    return static_cast<int>(ids.size());
  }
  void answer(OperatorKind kind, OperatorOutcome outcome, const std::string& reason = "") {
    for (const OperatorCommand& command : std::vector<OperatorCommand>(commands_))
      if (command.kind == kind) session_.answer({command.request_id, outcome, reason, "planner", 7}, now_us_);
    step();
  }
  static Json walk(int id) {
    return {{"type", "request"}, {"id", id}, {"command", "walk"}, {"parameters", {{"forward_m_s", 0.2}}}};
  }
  static Json sticks(double forward, bool dead_man) {
    return {{"type", "sticks"}, {"source", "keyboard"}, {"forward", forward},
            {"left", 0},        {"turning", 0},         {"dead_man", dead_man}};
  }

  std::int64_t now_us_ = 1'000'000;
  ConsoleSession session_{load_robot("pegasus"), {"best", false, 1}};
  std::vector<OperatorCommand> commands_, reads_;  ///< reads_: what the session asks by itself
  std::map<int, std::vector<Json>> told_;
  std::vector<int> closed_;
};

TEST_F(Console, ParametersAreReadFromTheRobotShownAndSetByTheDrivingPage) {
  open(1);
  open(2);
  EXPECT_GT(told_[1].front()["parameters"].size(), 40u);
  ASSERT_EQ(reads_.size(), 1u);
  RobotAnswer found{reads_.back().request_id,
                    OperatorOutcome::kDone,
                    "read",
                    "planner",
                    7,
                    parameter_id("compliance.stiffness.z"),
                    4000.0};
  session_.answer(found, now_us_);
  step();
  EXPECT_EQ(told_[2].back()["type"], "parameters");
  EXPECT_EQ(told_[2].back()["values"][3], 4000.0);
  const auto set = [&](int page, const Json& parameters) {
    say(page, {{"type", "request"}, {"id", 9}, {"command", "set_parameter"}, {"parameters", parameters}});
  };
  set(2, {{"parameter", "stand_length"}, {"value", 0.5}});
  EXPECT_EQ(said(OperatorKind::kSetParameter), 0) << "it watches";
  set(1, {{"parameter", "stand_length"}});
  set(1, {{"parameter", "no_such"}, {"value", 0.5}});
  EXPECT_EQ(said(OperatorKind::kSetParameter), 0);
  set(1, {{"parameter", "stand_length"}, {"value", 0.5}});
  ASSERT_EQ(said(OperatorKind::kSetParameter), 1);
  const auto order = std::find_if(commands_.begin(), commands_.end(), [](const OperatorCommand& c) {
    return c.kind == OperatorKind::kSetParameter;
  });
  EXPECT_EQ(order->parameter, parameter_id("stand_length"));
  EXPECT_EQ(order->parameter_value, 0.5);
}

TEST_F(Console, TheFirstPageDrivesAndTheSecondWatches) {
  open(1);
  open(2);
  EXPECT_EQ(session_.driver(), 1);
  say(2, {{"type", "request"}, {"id", 4}, {"command", "stand"}});
  EXPECT_EQ(said(OperatorKind::kStand), 0);
  EXPECT_EQ(told_[2].back()["id"], 4);
  EXPECT_THAT(told_[2].back()["reason"], HasSubstr("take the controls first"));
}

TEST_F(Console, APageThatOnlyLoadsDoesNotDriveYet) {
  session_.page_opened(1, now_us_);
  open(2);
  EXPECT_EQ(session_.driver(), 2) << "a busy browser may take seconds until it draws";
  say(1, {{"type", "alive"}});
  EXPECT_EQ(session_.driver(), 2);
}

TEST_F(Console, TakingOverIsExplicitAndTheOtherPageIsTold) {
  open(1);
  open(2);
  say(2, {{"type", "take_over"}});
  EXPECT_EQ(session_.driver(), 2);
  EXPECT_EQ(told_[1].back(), (Json{{"type", "role"}, {"driver", 2}, {"why", "it took the controls"}}));
  say(1, {{"type", "request"}, {"id", 4}, {"command", "stand"}});
  EXPECT_EQ(said(OperatorKind::kStand), 0);
}

TEST_F(Console, TakingOverEndsWhatTheOtherPageHeld) {
  open(1);
  open(2);
  say(1, walk(1));
  answer(OperatorKind::kWalk, OperatorOutcome::kDone);
  say(2, {{"type", "take_over"}});
  go_on(0.1);
  EXPECT_EQ(said(OperatorKind::kStop), 1);
}

TEST_F(Console, ARequestIsAnsweredToThePageThatAsked) {
  open(1);
  say(1, {{"type", "request"}, {"id", 4}, {"command", "stand"}});
  ASSERT_EQ(said(OperatorKind::kStand), 1);
  answer(OperatorKind::kStand, OperatorOutcome::kRefused, "a joint is not referenced: sprung home");
  EXPECT_EQ(told_[1].back()["outcome"], "refused");
  EXPECT_EQ(told_[1].back()["reason"], "a joint is not referenced: sprung home");
  EXPECT_EQ(told_[1].back()["id"], 4);
}

TEST_F(Console, EveryPageMayStopAndItIsSaidEvery20MsUntilNoDriveHasPower) {
  open(1);
  open(2);
  say(2, {{"type", "estop"}});
  ASSERT_EQ(commands_.size(), 1u) << "at once";
  go_on(0.2, [this] { session_.drives(true, now_us_); });
  EXPECT_GE(commands_.size(), 10u);
  session_.drives(false, now_us_);
  step();
  const std::size_t said_until_now = commands_.size();
  EXPECT_EQ(told_[1].back()["state"], "confirmed");
  answer(OperatorKind::kEstop, OperatorOutcome::kDone);
  go_on(0.5);
  EXPECT_EQ(commands_.size(), said_until_now);
}

/// As the server calls it: each tick, and when it is asked to; each time a little late.
TEST_F(Console, AnEmergencyStopIsNeverSaidLaterThan20MsAfterTheLastTime) {
  open(1);
  constexpr std::int64_t kLate_us = 1'000;
  std::int64_t next_tick_us = now_us_ + 11'300;
  say(1, {{"type", "estop"}});
  for (std::int64_t said_us = now_us_; now_us_ < 1'500'000;) {
    now_us_ = std::min(next_tick_us, session_.next_step_us()) + kLate_us;
    if (now_us_ >= next_tick_us) next_tick_us = now_us_ + kTick_us;
    const std::size_t before = commands_.size();
    step();
    ASSERT_LE(now_us_ - said_us, 20'000);
    if (commands_.size() > before) said_us = now_us_;
  }
}

TEST_F(Console, AnEmergencyStopIsOneRequestHoweverOftenItIsSaid) {
  open(1);
  for (int i = 0; i < 5; ++i) {
    say(1, {{"type", "estop"}});
    now_us_ += kTick_us;
  }
  for (const OperatorCommand& command : commands_)
    EXPECT_EQ(command.request_id, commands_.front().request_id);
}

TEST_F(Console, AnEmergencyStopEndsWhatWasHeldAndNothingRenewsIt) {
  open(1);
  say(1, walk(1));
  answer(OperatorKind::kWalk, OperatorOutcome::kDone);
  say(1, {{"type", "estop"}});
  const int before = said(OperatorKind::kHold);
  go_on(1.0, [this] { say(1, {{"type", "hold"}, {"held", true}}); });
  EXPECT_EQ(said(OperatorKind::kHold), before);
}

TEST_F(Console, AHeldWalkGoesOnAsLongAsThePageSaysSo) {
  open(1);
  say(1, walk(1));
  ASSERT_EQ(said(OperatorKind::kWalk), 1);
  EXPECT_EQ(commands_.back().hold_s, HeldMotion::kHold_s);
  answer(OperatorKind::kWalk, OperatorOutcome::kDone);
  go_on(1.0, [this] { say(1, {{"type", "hold"}, {"held", true}}); });
  EXPECT_GE(said(OperatorKind::kHold), 9);
  EXPECT_EQ(said(OperatorKind::kStop), 0);
  go_on(0.7);
  EXPECT_EQ(said(OperatorKind::kStop), 1) << "the page says nothing any more";
}

TEST_F(Console, AClosedPageEndsWhatItHeldAndNobodyDrives) {
  open(1);
  open(2);
  say(1, walk(1));
  session_.page_closed(1, now_us_);
  go_on(0.1);
  EXPECT_EQ(said(OperatorKind::kStop), 1);
  EXPECT_EQ(session_.driver(), -1);
  EXPECT_THAT(told_[2].back()["why"], HasSubstr("was closed"));
}

TEST_F(Console, APageThatSleepsLosesTheControlsAndMayComeBack) {
  open(1);
  open(2);
  go_on(1e-6 * ConsoleSession::kAsleep_us + 0.2,
        [this] { session_.text(2, R"({"type":"alive"})", now_us_); });
  EXPECT_EQ(session_.driver(), -1);
  say(1, {{"type", "request"}, {"id", 4}, {"command", "stand"}});
  EXPECT_EQ(said(OperatorKind::kStand), 0) << "it does not know that it slept";
  say(1, {{"type", "take_over"}});
  EXPECT_EQ(session_.driver(), 1);
}

TEST_F(Console, SticksDriveOnlyAfterTheyWereSeenAtRest) {
  open(1);
  say(1, sticks(1.0, true));
  EXPECT_EQ(said(OperatorKind::kWalk), 0);
  say(1, sticks(0.0, false));
  say(1, sticks(1.0, true));
  EXPECT_EQ(said(OperatorKind::kWalk), 1);
  answer(OperatorKind::kWalk, OperatorOutcome::kDone);
  go_on(1.0, [this] { say(1, sticks(1.0, true)); });
  EXPECT_GE(said(OperatorKind::kHold), 8);
  say(1, sticks(0.0, false));
  go_on(0.1);
  EXPECT_EQ(said(OperatorKind::kStop), 1);
}

TEST_F(Console, SticksThatAreNotHeardAnyMoreEndTheWalk) {
  open(1);
  say(1, sticks(0.0, false));
  say(1, sticks(1.0, true));
  go_on(0.8, [this] { session_.text(1, R"({"type":"alive"})", now_us_); });
  EXPECT_EQ(said(OperatorKind::kStop), 1);
  EXPECT_EQ(session_.status_json(now_us_)["sticks"]["state"], "locked");
}

TEST_F(Console, SticksOfAPageThatWatchesMoveNothing) {
  open(1);
  open(2);
  say(2, sticks(0.0, false));
  say(2, sticks(1.0, true));
  EXPECT_EQ(said(OperatorKind::kWalk), 0);
}

TEST_F(Console, ARefusedWalkBySticksIsToldAndNotRepeated) {
  open(1);
  say(1, sticks(0.0, false));
  say(1, sticks(1.0, true));
  answer(OperatorKind::kWalk, OperatorOutcome::kRefused, "not standing: stand first");
  EXPECT_THAT(told_[1].back()["text"], HasSubstr("not standing"));
  go_on(1.0, [this] { say(1, sticks(1.0, true)); });
  EXPECT_EQ(said(OperatorKind::kWalk), 1);
}

TEST_F(Console, WhatIsNoMessageIsAnsweredWithAnErrorAndAtLastTheDoorIsShut) {
  open(1);
  for (const std::string& bad :
       {std::string("{"), std::string("[]"), std::string("null"), std::string("\xff\xfe"),
        std::string(5000, '['), std::string(R"({"type":7})"), std::string(R"({"type":"explode"})"),
        std::string(R"({"type":"request"})"), std::string(R"({"type":"request","id":1.5,"command":"stand"})"),
        std::string(R"({"type":"sticks","source":"x","forward":"1","left":0,"turning":0,"dead_man":true})"),
        std::string(R"({"type":"hold"})"), "{\"type\":\"\xff\"}" + std::string()}) {
    told_[1].clear();
    session_.text(1, bad, now_us_);
    step();
    ASSERT_EQ(told_[1].size(), 1u) << bad;
    EXPECT_EQ(told_[1].back()["type"], "error") << bad;
  }
  EXPECT_TRUE(closed_.empty());
  for (int i = 0; i < ConsoleSession::kMostBadTexts; ++i) session_.text(1, "{", now_us_);
  step();
  EXPECT_EQ(closed_, std::vector<int>{1});
  EXPECT_TRUE(commands_.empty());
}

TEST_F(Console, EnableMovesNothingOutsideMaintenance) {
  open(1);
  go_on(0.5, [this] { say(1, {{"type", "enable"}, {"held", true}}); });
  EXPECT_EQ(said(OperatorKind::kEnable), 0);
}

TEST_F(Console, InMaintenanceTheHeldKeyEnablesUntilItIsLetGo) {
  ConsoleSession session(load_robot("pegasus"), {"best", true, 1});
  session.page_opened(1, 0);
  int enabled = 0;
  for (std::int64_t now_us = 0; now_us < 2'000'000; now_us += kTick_us) {
    if (now_us < 1'000'000) session.text(1, R"({"type":"enable","held":true})", now_us);
    for (const OperatorCommand& command : session.step(now_us).commands)
      enabled += command.kind == OperatorKind::kEnable && now_us > 1'600'000 ? 100 : 1;
  }
  EXPECT_GE(enabled, 10);
  EXPECT_LT(enabled, 40) << "said after the key was let go";
}

}  // namespace
}  // namespace sprung::station
