/// Single joints moved from the command line, by real processes in lock-step; the leg hangs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Move : public SystemTest {
 protected:
  void hang() { up("lockstep", "--plant suspended=0.8"); }
  std::string motion() const {
    return nlohmann::json::parse(sprung("status --json").output)["motion"]["state"].get<std::string>();
  }
};

TEST_F(Move, JointGoesWhereItIsToldHoldsAndIsLetGo) {
  hang();
  const CommandResult to = sprung("move knee --to 1.5rad --speed 3rad/s --acceleration 20rad/s^2 --json");
  ASSERT_EQ(to.status, 0) << to.output;
  const auto json = nlohmann::json::parse(to.output);
  EXPECT_EQ(json["outcome"], "done");
  EXPECT_NEAR(json["position_rad"].get<double>(), 1.5, 0.05);
  EXPECT_EQ(motion(), "moving joint");
  const CommandResult by = sprung("move hip --by -10deg");
  EXPECT_EQ(by.status, 0) << by.output;
  EXPECT_THAT(by.output, HasSubstr("move: done: joint move ended, joints held"));
  EXPECT_THAT(sprung("stand").output, HasSubstr("busy: single joints are held, sit first"));
  const CommandResult sit = sprung("sit");
  EXPECT_EQ(sit.status, 0) << sit.output;
  EXPECT_EQ(motion(), "idle");
}

TEST_F(Move, WhatCannotBeIsRefusedWithTheLimits) {
  hang();
  const CommandResult far = sprung("move knee --to 7rad");
  EXPECT_EQ(far.status, 1);
  EXPECT_THAT(far.output, HasSubstr("refused: target is not within the joint's position limits"));
  EXPECT_THAT(far.output, HasSubstr("limits of knee: 0.070 to 2.600 rad, 12 rad/s"));
  EXPECT_EQ(sprung("move knee --to 1.5rad --speed 13rad/s").status, 1);
  EXPECT_EQ(sprung("move knee --to 1.5").status, 2);
  EXPECT_EQ(sprung("move knee").status, 2);
  EXPECT_EQ(sprung("move knee --to 1rad --by 1rad").status, 2);
  const CommandResult ankle = sprung("move ankle --to 1rad");
  EXPECT_EQ(ankle.status, 2);
  EXPECT_THAT(ankle.output, HasSubstr("there are: hip, knee"));
  EXPECT_EQ(motion(), "idle");
}

TEST_F(Move, UpAndStatusSayThatMotionDisagreesWithTheModel) {
  up("lockstep", "--plant friction_scale=2.5 --plant suspended=0.8");
  for (const char* angle : {"1.2rad", "0.5rad", "1.5rad", "0.6rad", "1.8rad"})
    ASSERT_EQ(sprung(std::string("move knee --to ") + angle + " --speed 2rad/s").status, 0);
  const std::string note = "the model does not fit what moves: knee";
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kTimeout_s);
  while (said().find(note) == std::string::npos && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_THAT(said(), HasSubstr("note: " + note));
  EXPECT_THAT(said(), HasSubstr("repeat: sprung identify --record single_leg knee"));
  EXPECT_THAT(sprung("status").output, AllOf(HasSubstr("says    sprung-torque-estimator: " + note),
                                             HasSubstr("repeat: sprung identify --record single_leg knee")));
}

}  // namespace
}  // namespace sprung
