#include "tools/lab/identify/record_protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "planner/joint_move.h"
#include "robots/robot_loader.h"
#include "tests/support/enumerators.h"

namespace sprung::identify {
namespace {

/// Constant speeds of the protocol, slowest first.
std::set<double> speeds_of(const std::vector<RecordMove>& moves, const RecordRange& range) {
  std::set<double> speeds;
  for (const RecordMove& move : moves) {
    if (move.part == RecordPart::kSpeeds && move.acceleration_rad_s2 == range.acceleration_rad_s2)
      speeds.insert(move.speed_rad_s);
  }
  return speeds;
}

TEST(RecordParts, EveryOneHasItsOwnName) { test::expect_own_names<RecordPart>(); }

TEST(RecordProtocol, NeverLeavesItsRangeWhateverThatIs) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-4.0, 4.0), exponent(-3.0, 2.0);
  for (int n = 0; n < 300; ++n) {
    const double low_rad = angle(random);
    const RecordRange range{low_rad, low_rad + std::pow(10.0, 0.4 * exponent(random) - 0.2),
                            std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random))};
    double at_rad = angle(random);
    const std::vector<RecordMove> moves = record_protocol(range, at_rad);
    bool inside = false;  // it begins wherever the joint is
    for (const RecordMove& move : moves) {
      ASSERT_GE(move.target_rad, range.low_rad);
      ASSERT_LE(move.target_rad, range.high_rad);
      ASSERT_GT(move.speed_rad_s, 0.0);
      ASSERT_LE(move.speed_rad_s, range.speed_rad_s);
      ASSERT_GT(move.acceleration_rad_s2, 0.0);
      ASSERT_LE(move.acceleration_rad_s2, range.acceleration_rad_s2);
      const JointMove path(at_rad, move.target_rad, move.speed_rad_s, move.acceleration_rad_s2);
      for (int k = 0; k <= 20; ++k) {
        const double now_rad = path.at(path.duration_s() * k / 20).position_rad;
        if (inside) {
          ASSERT_GE(now_rad, range.low_rad - 1e-9);
          ASSERT_LE(now_rad, range.high_rad + 1e-9);
        }
      }
      at_rad = move.target_rad;
      inside = true;
    }
  }
}

TEST(RecordProtocol, CoversEightSpeedsEvenlyInTheirLogarithmBothWays) {
  for (const char* robot_name : {"single_leg", "pegasus", "test_axis"}) {
    const RobotConfig robot = load_robot(robot_name);
    const RecordRange range = record_range(robot, 0);
    const std::vector<RecordMove> moves = record_protocol(range, 0.0);
    const std::set<double> speeds = speeds_of(moves, range);
    ASSERT_EQ(speeds.size(), 8u) << robot_name;
    EXPECT_LE(*speeds.begin(), 0.02);
    EXPECT_GT(*speeds.rbegin(), 1.0) << robot_name;
    double before = *speeds.begin();
    const double step = std::pow(*speeds.rbegin() / *speeds.begin(), 1.0 / 7.0);
    for (auto it = std::next(speeds.begin()); it != speeds.end(); ++it) {
      EXPECT_NEAR(*it / before, step, 1e-6);
      before = *it;
    }
    int up = 0, down = 0;
    for (std::size_t i = 1; i < moves.size(); ++i) {
      if (moves[i].part != RecordPart::kSpeeds || speeds.count(moves[i].speed_rad_s) == 0) continue;
      ++(moves[i].target_rad > moves[i - 1].target_rad ? up : down);
    }
    EXPECT_GE(up, 8);
    EXPECT_GE(down, 8);
  }
}

TEST(RecordProtocol, EveryConstantSpeedIsReachedAndLastsForHalfOfThePass) {
  const RobotConfig robot = load_robot("single_leg");
  const RecordRange range = record_range(robot, 1);
  const std::vector<RecordMove> moves = record_protocol(range, 1.0);
  const std::set<double> speeds = speeds_of(moves, range);
  for (std::size_t i = 1; i < moves.size(); ++i) {
    const RecordMove& move = moves[i];
    if (move.part != RecordPart::kSpeeds || move.acceleration_rad_s2 != range.acceleration_rad_s2) continue;
    const double way_rad = std::abs(move.target_rad - moves[i - 1].target_rad);
    const double ramps_rad = move.speed_rad_s * move.speed_rad_s / move.acceleration_rad_s2;
    EXPECT_LE(ramps_rad, 0.5 * way_rad + 1e-9) << move.speed_rad_s;
  }
  EXPECT_FALSE(speeds.empty());
}

TEST(RecordProtocol, StopsCoverTheWholeRangeFromBothSides) {
  const RecordRange range{0.0, 3.0, 4.0, 20.0};
  std::multiset<long> stops;
  for (const RecordMove& move : record_protocol(range, 1.0)) {
    if (move.part != RecordPart::kStops) continue;
    EXPECT_GT(move.pause_s, 0.0);
    stops.insert(std::lround(move.target_rad * 1000));
  }
  EXPECT_EQ(std::set<long>(stops.begin(), stops.end()).size(), 7u);
  EXPECT_EQ(stops.count(1500), 2u);
  EXPECT_EQ(stops.count(3000), 1u);
}

TEST(RecordProtocol, SwingsHaveTwoAccelerations) {
  const RecordRange range{0.0, 3.0, 4.0, 20.0};
  std::set<double> accelerations;
  for (const RecordMove& move : record_protocol(range, 1.0)) {
    if (move.part == RecordPart::kSwings && move.pause_s == 0.0)
      accelerations.insert(move.acceleration_rad_s2);
  }
  EXPECT_EQ(accelerations, (std::set<double>{8.0, 20.0}));
}

TEST(RecordProtocol, ReturnsToWhereTheJointWas) {
  const RecordRange range{0.0, 3.0, 4.0, 20.0};
  EXPECT_EQ(record_protocol(range, 1.234).back().target_rad, 1.234);
  EXPECT_EQ(record_protocol(range, 3.1).back().target_rad, 3.0);
}

TEST(RecordProtocol, RangeKeepsClearOfTheRobotsLimits) {
  for (const char* robot_name : {"single_leg", "pegasus", "test_axis"}) {
    const RobotConfig robot = load_robot(robot_name);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const RecordRange range = record_range(robot, static_cast<int>(j));
      EXPECT_GE(range.low_rad, robot.joints[j].position_min_rad + 0.12 - 1e-12);
      EXPECT_LE(range.high_rad, robot.joints[j].position_max_rad - 0.12 + 1e-12);
      EXPECT_LE(range.speed_rad_s, 0.5 * robot.actuators[j].speed_limit_rad_s + 1e-12);
      const double accelerating_Nm = range.acceleration_rad_s2 * robot.joints[j].armature_kg_m2;
      EXPECT_LE(accelerating_Nm, 0.15 * robot.actuators[j].torque_limit_Nm + 1e-9);
      EXPECT_GT(accelerating_Nm, 5.0) << "well above noise and friction's uncertainty";
    }
  }
}

TEST(RecordProtocol, NarrowLimitsKeepHalfOfTheirWayAndNoneIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints[0].position_min_rad = 0.0;
  robot.joints[0].position_max_rad = 0.14;
  const RecordRange range = record_range(robot, 0);
  EXPECT_NEAR(range.high_rad - range.low_rad, 0.05, 1e-9);
  robot.joints[0].position_max_rad = 0.03;
  EXPECT_THROW(record_range(robot, 0), std::invalid_argument);
}

TEST(RecordProtocol, UnknownArmatureStillGivesAFiniteAcceleration) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints[0].armature_kg_m2 = 0.0;
  EXPECT_NEAR(record_range(robot, 0).acceleration_rad_s2, 30.0, 1e-9);
}

TEST(RecordProtocol, OperatorMayOnlyNarrow) {
  const RecordRange range{0.0, 3.0, 4.0, 20.0};
  const RecordRange some = narrowed(range, {0.5, 9.0, 1.0});
  EXPECT_EQ(some.low_rad, 0.5);
  EXPECT_EQ(some.high_rad, 3.0);
  EXPECT_EQ(some.speed_rad_s, 1.0);
  EXPECT_EQ(narrowed(range, {}).high_rad, 3.0);
  EXPECT_THROW(narrowed(range, {2.0, 1.0, kNaN}), std::invalid_argument);
  EXPECT_THROW(narrowed(range, {kNaN, kNaN, 0.0}), std::invalid_argument);
}

TEST(RecordProtocol, TakesItsTimeButNotMuch) {
  for (const char* robot_name : {"single_leg", "pegasus", "test_axis"}) {
    const RobotConfig robot = load_robot(robot_name);
    const double seconds = duration_s(record_protocol(record_range(robot, 0), 0.0), 0.0);
    EXPECT_GT(seconds, 30.0) << robot_name;
    EXPECT_LT(seconds, 150.0) << robot_name;
  }
}

TEST(RecordProtocol, PartsHaveNames) {
  std::set<std::string> names;
  for (const RecordPart part : {RecordPart::kApproach, RecordPart::kStops, RecordPart::kSpeeds,
                                RecordPart::kSwings, RecordPart::kReturn})
    names.insert(name(part));
  EXPECT_EQ(names.size(), 5u);
}

}  // namespace
}  // namespace sprung::identify
