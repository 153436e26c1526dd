/// A program of the stack that dies or is stopped while the robot walks or jumps, at a drawn moment: how soon
/// nothing drives the joints any more, and how the robot comes down. SPRUNG_SEEDS asks for more seeds than
/// two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <tuple>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"
#include "tests/simulation/in_process/seeds.h"

namespace sprung {
namespace {

constexpr int kCrawl = 1, kWalk = 2, kTrot = 3;
const char* const kGaitNames[] = {"stand", "crawl", "walk", "trot"};
const char* const kProcessNames[] = {"bridge", "estimator", "planner", "controller"};

/// A pegasus that walks, stopped in its stride.
class Walking {
 public:
  Walking(int gait, std::uint64_t seed) : random_(seed), robot_(config_, "best", options(seed)) {
    test::stand_up(robot_, true);
    robot_.submit(test::walk_order(gait, gait == kTrot ? 0.3 : 0.1, 3));
    ticks(1500 + static_cast<int>(random_() % 1500));
  }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) robot_.tick();
  }
  /// @return time until `done`, at most `limit_s`; -1: never.
  template <class Done>
  double until(double limit_s, const Done& done) {
    for (double t = 0.0; t < limit_s; t += config_.cycle_s) {
      if (done()) return t;
      robot_.tick();
    }
    return -1.0;
  }
  /// No motor has torque, or the bridge damps, or it has switched off.
  bool safe() {
    if (robot_.bridge().safety().level != SafetyLevel::kOperational) return true;
    for (int i = 0; i < static_cast<int>(config_.actuators.size()); ++i)
      if (robot_.sim().true_motor_torque_Nm(i) != 0.0) return false;
    return true;
  }
  bool powered() const {
    const auto& actuators = robot_.drive_state().actuators;
    return std::any_of(actuators.begin(), actuators.end(),
                       [](const ActuatorState& a) { return a.power_state == PowerState::kOperationEnabled; });
  }
  InProcessRobot& robot() { return robot_; }
  std::mt19937_64& random() { return random_; }
  double cycle_s() const { return config_.cycle_s; }

 private:
  static SimOptions options(std::uint64_t seed) {
    SimOptions sim;
    sim.seed = seed;
    return sim;
  }

  RobotConfig config_ = load_robot("pegasus");
  std::mt19937_64 random_;
  InProcessRobot robot_;
};

using Case = std::tuple<StackProcess, int, std::uint64_t>;

class DeadProcess : public testing::TestWithParam<Case> {
 protected:
  static StackProcess which() { return std::get<0>(GetParam()); }
  Walking walking_{std::get<1>(GetParam()), std::get<2>(GetParam())};
};

TEST_P(DeadProcess, NothingDrivesWithin60ms) {
  ASSERT_EQ(walking_.robot().motion_state().state, MotionPhase::kWalking);
  walking_.robot().stop(which());
  const double safe_s = walking_.until(1.0, [&] { return walking_.safe(); });
  std::printf("without torque, or damped, after %.0f ms\n", 1e3 * safe_s);
  EXPECT_GE(safe_s, 0.0);
  EXPECT_LE(safe_s, 0.060);
  walking_.ticks(3000);
  EXPECT_TRUE(walking_.safe()) << "and stays so";
  EXPECT_TRUE(which() == StackProcess::kBridge || !walking_.powered());
}

std::string process_gait_and_seed(const testing::TestParamInfo<Case>& one) {
  return std::string(kProcessNames[static_cast<int>(std::get<0>(one.param))]) + "_" +
         kGaitNames[std::get<1>(one.param)] + "_seed_" + std::to_string(std::get<2>(one.param));
}

INSTANTIATE_TEST_SUITE_P(OfAWalkingRobot, DeadProcess,
                         testing::Combine(testing::Values(StackProcess::kBridge, StackProcess::kEstimator,
                                                          StackProcess::kController),
                                          testing::Values(kTrot),
                                          testing::Range<std::uint64_t>(1, 1 + test::seeds(1))),
                         process_gait_and_seed);

class StoppedProcess : public testing::TestWithParam<Case> {
 protected:
  Walking walking_{std::get<1>(GetParam()), std::get<2>(GetParam())};
};

/// SIGSTOP, and SIGCONT after 5 to 500 ms.
TEST_P(StoppedProcess, RobotWalksOnOrStaysOff) {
  const int stopped = static_cast<int>(
      std::exp(std::uniform_real_distribution<>(std::log(0.005), std::log(0.5))(walking_.random())) /
      walking_.cycle_s());
  walking_.robot().stop(std::get<0>(GetParam()));
  walking_.ticks(stopped);
  walking_.robot().stop(std::get<0>(GetParam()), false);
  walking_.ticks(3000);
  const SafetyState safety = walking_.robot().bridge().safety();
  std::printf("stopped %.0f ms: %s, %s, %s\n", 1e3 * stopped * walking_.cycle_s(), name(safety.level),
              name(safety.cause), name(walking_.robot().motion_state().state));
  // A stall that made the bridge damp has ended the motion: the planner has let go, and waits for `stand`.
  const bool walks = walking_.robot().motion_state().state == MotionPhase::kWalking;
  if (walks) {
    EXPECT_EQ(safety.level, SafetyLevel::kOperational);
  } else {
    EXPECT_FALSE(walking_.powered());
    EXPECT_EQ(walking_.robot().motion_state().state, MotionPhase::kIdle);
    EXPECT_TRUE(safety.latched || stopped * walking_.cycle_s() <= 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(OfAWalkingRobot, StoppedProcess,
                         testing::Combine(testing::Values(StackProcess::kBridge, StackProcess::kEstimator,
                                                          StackProcess::kPlanner, StackProcess::kController),
                                          testing::Values(kTrot),
                                          testing::Range<std::uint64_t>(1, 1 + test::seeds(1))),
                         process_gait_and_seed);

class DeadPlanner : public testing::TestWithParam<std::tuple<int, std::uint64_t>> {};

TEST_P(DeadPlanner, RobotIsLetDownThenOff) {
  Walking walking(std::get<0>(GetParam()), std::get<1>(GetParam()));
  InProcessRobot& robot = walking.robot();
  robot.stop(StackProcess::kPlanner);
  double fastest_m_s = 0.0;
  const double low_s = walking.until(1.25, [&] {
    fastest_m_s = std::max(fastest_m_s, -robot.truth().base_velocity_m_s[2]);
    return false;
  });
  EXPECT_EQ(low_s, -1.0);
  EXPECT_EQ(robot.bridge().safety().level, SafetyLevel::kLowering);
  const SimTruth& low = robot.truth();
  const double upright = 1.0 - 2.0 * (low.base_quaternion_wxyz[1] * low.base_quaternion_wxyz[1] +
                                      low.base_quaternion_wxyz[2] * low.base_quaternion_wxyz[2]);
  EXPECT_NEAR(low.base_in_world_m[2], 0.24, 0.06) << "sit_length of the preset";
  EXPECT_GE(upright, 0.97) << "its trunk stays level";
  const double off_s = 1.25 + walking.until(6.0, [&] {
    fastest_m_s = std::max(fastest_m_s, -robot.truth().base_velocity_m_s[2]);
    return !walking.powered();
  });
  const double height_m = robot.truth().base_in_world_m[2];
  const SafetyState safety = robot.bridge().safety();
  std::printf("sank at %.2f m/s at most, off after %.2f s at %.2f m: %s\n", fastest_m_s, off_s, height_m,
              safety.detail.data());
  EXPECT_EQ(safety.cause, SafetyCause::kPlannerLost);
  EXPECT_TRUE(safety.latched);
  EXPECT_GE(off_s, 1.5);
  EXPECT_LE(off_s, 3.3) << "1.5 s, and until the joints have rested";
  EXPECT_LE(fastest_m_s, 0.6);
  robot.stop(StackProcess::kPlanner, false);
  walking.ticks(500);
  EXPECT_FALSE(walking.powered()) << "one that comes back moves nothing";
}

std::string gait_then_seed(const testing::TestParamInfo<std::tuple<int, std::uint64_t>>& one) {
  return std::string(kGaitNames[std::get<0>(one.param)]) + "_seed_" + std::to_string(std::get<1>(one.param));
}

INSTANTIATE_TEST_SUITE_P(OfAWalkingRobot, DeadPlanner,
                         testing::Combine(testing::Values(kCrawl, kWalk, kTrot),
                                          testing::Range<std::uint64_t>(1, 1 + test::seeds(1))),
                         gait_then_seed);

class DeadPlannerInAJump : public testing::TestWithParam<MotionPhase> {};

TEST_P(DeadPlannerInAJump, LegIsBroughtToRestThenOff) {
  const RobotConfig config = load_robot("single_leg");
  InProcessRobot robot(config, "best", {});
  test::stand_up(robot, false);
  robot.submit(test::order_of(OperatorKind::kJump, 3));
  test::tick_until(robot, GetParam());
  robot.stop(StackProcess::kPlanner);
  const auto powered = [&] {
    const auto& actuators = robot.drive_state().actuators;
    return std::any_of(actuators.begin(), actuators.end(),
                       [](const ActuatorState& a) { return a.power_state == PowerState::kOperationEnabled; });
  };
  double off_s = 0.0, beyond_rad = 0.0;
  for (; powered() && off_s < 6.0; off_s += config.cycle_s) {
    robot.tick();
    for (std::size_t j = 0; j < config.joints.size(); ++j) {
      const double at_rad = robot.truth().joints[j].true_position_rad;
      beyond_rad = std::max({beyond_rad, config.joints[j].position_min_rad - at_rad,
                             at_rad - config.joints[j].position_max_rad});
    }
  }
  std::printf("off after %.2f s, %.3f rad beyond its limits\n", off_s, beyond_rad);
  EXPECT_EQ(robot.bridge().safety().cause, SafetyCause::kPlannerLost);
  EXPECT_LE(off_s, 3.3);
  EXPECT_LE(beyond_rad, 0.06) << "its stops are 0.05 rad beyond";
}

std::string phase_name(const testing::TestParamInfo<MotionPhase>& one) { return name(one.param); }

INSTANTIATE_TEST_SUITE_P(OfASingleLeg, DeadPlannerInAJump,
                         testing::Values(MotionPhase::kCrouch, MotionPhase::kThrust, MotionPhase::kFlight,
                                         MotionPhase::kLanding, MotionPhase::kRecover),
                         phase_name);

}  // namespace
}  // namespace sprung
