/// An operator who walks a robot and is gone from one moment to the next (hazard 5: it walked on): how soon
/// the body rests and the robot stands, as it truly does. SPRUNG_SEEDS asks for more seeds than two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"
#include "tests/simulation/in_process/seeds.h"

namespace sprung {
namespace {

constexpr double kHold_s = 0.5;  // as `sprung walk` asks for

struct GaitToLeave {
  int gait;
  double speed_m_s;
  double rests_within_s;   ///< from the last renewal: within 50 mm of where it ends, for good
  double stands_within_s;  ///< every foot in its place, `standing`
};

class OperatorGone : public testing::TestWithParam<std::tuple<GaitToLeave, std::uint64_t>> {
 protected:
  static const GaitToLeave& gait() { return std::get<0>(GetParam()); }
  static std::uint64_t seed() { return std::get<1>(GetParam()); }

  /// From feet that nobody has set in their places.
  static void goes_on_and_sits(InProcessRobot& robot) {
    robot.submit(test::walk_order(gait().gait, gait().speed_m_s, 9001));
    for (int i = 0; i < 3000; ++i) robot.tick();
    ASSERT_EQ(robot.motion_state().state, MotionPhase::kWalking) << robot.motion_state().last_transition;
    robot.submit(test::order_of(OperatorKind::kStop, 9002));
    test::tick_until(robot, MotionPhase::kStanding);
    robot.submit(test::order_of(OperatorKind::kSit, 9003));
    test::tick_until(robot, MotionPhase::kIdle);
    EXPECT_EQ(robot.bridge().safety().level, SafetyLevel::kOperational);
  }
};

TEST_P(OperatorGone, RobotRestsAndStands) {
  const RobotConfig config = load_robot("pegasus");
  SimOptions sim;
  sim.seed = seed();
  InProcessRobot robot(config, "best", sim);
  test::stand_up(robot, true);
  robot.submit(test::walk_order(gait().gait, gait().speed_m_s, 3, kHold_s));
  const int walked = 2000 + 61 * static_cast<int>(seed());  // somewhere in a step
  for (int i = 0; i < walked; ++i) {
    if (i % 62 == 0) {
      OperatorCommand renewal = test::order_of(OperatorKind::kHold, 10 + i);
      renewal.hold_s = kHold_s;
      robot.submit(renewal);
    }
    robot.tick();
  }
  ASSERT_EQ(robot.motion_state().state, MotionPhase::kWalking);
  double stands_s = -1.0;
  std::vector<double> way_m;
  for (double t = 0.0; t < 6.0; t += config.cycle_s) {
    way_m.push_back(robot.truth().base_in_world_m[0]);
    robot.tick();
    if (stands_s < 0.0 && robot.motion_state().state == MotionPhase::kStanding) stands_s = t;
  }
  const auto far = std::find_if(way_m.rbegin(), way_m.rend(),
                                [&](double x) { return std::abs(x - way_m.back()) > 0.05; });
  const double rests_s = config.cycle_s * static_cast<double>(way_m.rend() - far);
  std::printf("rests after %.2f s and %.0f mm, stands after %.2f s\n", rests_s,
              1e3 * (way_m.back() - way_m.front()), stands_s);
  EXPECT_EQ(robot.bridge().safety().level, SafetyLevel::kOperational);
  EXPECT_LE(rests_s, gait().rests_within_s);
  EXPECT_LE(way_m.back() - way_m.front(), 0.35);
  EXPECT_GE(stands_s, 0.0);
  EXPECT_LE(stands_s, gait().stands_within_s);
  for (const TrueLeg& leg : robot.truth().legs) EXPECT_GT(leg.true_contact_force_N[2], 10.0);
  goes_on_and_sits(robot);
}

/// A crawl sways by 0.1 m while it sets one foot after another; it goes no further.
constexpr GaitToLeave kGaits[] = {{3, 0.3, 1.0, 2.0}, {2, 0.2, 1.0, 2.0}, {1, 0.1, 1.4, 2.0}};
constexpr const char* kLeftGaitNames[] = {"stand", "crawl", "walk", "trot"};

std::string gait_and_seed(const testing::TestParamInfo<OperatorGone::ParamType>& one) {
  return std::string(kLeftGaitNames[std::get<0>(one.param).gait]) + "_seed_" +
         std::to_string(std::get<1>(one.param));
}

INSTANTIATE_TEST_SUITE_P(Hazard5, OperatorGone,
                         testing::Combine(testing::ValuesIn(kGaits),
                                          testing::Range<std::uint64_t>(1, 1 + test::seeds())),
                         gait_and_seed);

}  // namespace
}  // namespace sprung
