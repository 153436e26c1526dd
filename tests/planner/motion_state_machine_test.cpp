#include "planner/motion_state_machine.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/support/enumerators.h"

namespace sprung {
namespace {

constexpr int kStates = kWords<MotionPhase>.size();
constexpr int kEvents = kWords<MotionEvent>.size();

/// Shortest way from idle to each state, over rows of the table.
std::vector<MotionEvent> way_to(MotionPhase state) {
  using E = MotionEvent;
  switch (state) {
    case MotionPhase::kIdle:
      return {};
    case MotionPhase::kRising:
      return {E::kStandRequested};
    case MotionPhase::kStanding:
      return {E::kStandRequested, E::kRisen};
    case MotionPhase::kCrouch:
      return {E::kStandRequested, E::kRisen, E::kJumpRequested};
    case MotionPhase::kThrust:
      return {E::kStandRequested, E::kRisen, E::kJumpRequested, E::kCrouched};
    case MotionPhase::kFlight:
      return {E::kStandRequested, E::kRisen, E::kJumpRequested, E::kCrouched, E::kLiftOff};
    case MotionPhase::kLanding:
      return {E::kStandRequested, E::kRisen, E::kJumpRequested, E::kCrouched, E::kThrustTimeout};
    case MotionPhase::kRecover:
      return {E::kStandRequested, E::kRisen, E::kJumpRequested, E::kStopped};
    case MotionPhase::kSitting:
      return {E::kStandRequested, E::kRisen, E::kSitRequested};
    case MotionPhase::kMovingJoint:
      return {E::kJointRequested};
    case MotionPhase::kComplying:
      return {E::kStandRequested, E::kRisen, E::kComplyRequested};
    case MotionPhase::kWalking:
      return {E::kStandRequested, E::kRisen, E::kWalkRequested};
    case MotionPhase::kFallen:
      return {E::kStandRequested, E::kRisen, E::kFell};
  }
  return {};
}

MotionStateMachine machine_in(MotionPhase state) {
  MotionStateMachine machine;
  for (MotionEvent event : way_to(state)) machine.process_event(event);
  EXPECT_EQ(machine.state(), state);
  return machine;
}

TEST(MotionEvents, EveryOneHasItsOwnName) { test::expect_own_names<MotionEvent>(); }

TEST(MotionStateMachineTest, EveryRowOfTheTableIsTakenAndNothingElse) {
  for (int s = 0; s < kStates; ++s) {
    for (int e = 0; e < kEvents; ++e) {
      const auto state = static_cast<MotionPhase>(s);
      const auto event = static_cast<MotionEvent>(e);
      MotionStateMachine machine = machine_in(state);
      const MotionTransition* expected = nullptr;
      for (const MotionTransition& row : motion_transitions()) {
        const bool from_here = row.from ? *row.from == state : state != MotionPhase::kIdle;
        if (from_here && row.event == event) expected = &row;
      }
      EXPECT_EQ(machine.process_event(event), expected) << name(state) << ", " << name(event);
      EXPECT_EQ(machine.state(), expected != nullptr ? expected->to : state);
    }
  }
}

TEST(MotionStateMachineTest, NoTwoRowsContradict) {
  std::set<std::pair<int, int>> seen;
  for (const MotionTransition& row : motion_transitions()) {
    const int from = row.from ? static_cast<int>(*row.from) : -1;
    EXPECT_TRUE(seen.insert({from, static_cast<int>(row.event)}).second) << row.reason;
    EXPECT_NE(std::string(row.reason), "");
  }
}

TEST(MotionStateMachineTest, EveryMovingStateEndsIdleWhenSafetyIsLost) {
  for (int s = 1; s < kStates; ++s) {
    MotionStateMachine machine = machine_in(static_cast<MotionPhase>(s));
    ASSERT_NE(machine.process_event(MotionEvent::kSafetyLost), nullptr);
    EXPECT_EQ(machine.state(), MotionPhase::kIdle);
    EXPECT_STREQ(machine.last()->reason, "stopped by safety");
  }
}

TEST(MotionStateMachineTest, ThrustIsNeverEnteredButFromTheCrouch) {
  for (const MotionTransition& row : motion_transitions()) {
    if (row.to == MotionPhase::kThrust) {
      EXPECT_EQ(row.from, MotionPhase::kCrouch);
    }
  }
}

}  // namespace
}  // namespace sprung
