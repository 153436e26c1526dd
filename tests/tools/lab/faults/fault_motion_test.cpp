#include "tools/lab/faults/fault_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tools/lab/faults/fault_experiment.h"

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FaultOutcome strike(const char* robot, FaultKind kind, const std::string& motion, std::uint64_t seed = 3) {
  const RobotConfig config = load_robot(robot);
  SimOptions sim;
  sim.seed = seed;
  for (const FaultCase& fault : fault_cases(config))
    if (fault.kind == kind) return run_fault(config, "best", sim, fault, motion);
  return {};
}

TEST(FaultMotions, AreWhatTheRobotCanDo) {
  EXPECT_THAT(fault_motions(load_robot("single_leg")),
              ElementsAre("standing", "comply", "crouch", "thrust", "flight", "landing"));
  EXPECT_THAT(fault_motions(load_robot("pegasus")),
              ElementsAre("standing", "comply", "crawl", "walk", "trot"));
  EXPECT_THAT(fault_motions(load_robot("test_axis")), ElementsAre("standing"));
}

TEST(FaultMotions, StuckEncoderIsNoticedInAThrustThoughNotInAStand) {
  const FaultOutcome thrust = strike("single_leg", FaultKind::kEncoderStuck, "thrust");
  EXPECT_EQ(thrust.cause, SafetyCause::kImplausible);
  EXPECT_LE(thrust.detected_s, 0.05);
  EXPECT_EQ(strike("single_leg", FaultKind::kEncoderStuck, kNoMotion).cause, SafetyCause::kNone);
}

TEST(FaultMotions, DriveFaultOfAWalkingRobotIsNamedAndEndsWithoutTorque) {
  const FaultOutcome trot = strike("pegasus", FaultKind::kOverCurrent, "trot");
  EXPECT_EQ(trot.cause, SafetyCause::kDriveFault);
  EXPECT_LE(trot.detected_s, 0.01);
  EXPECT_EQ(trot.worst, SafetyLevel::kQuickStop);
}

TEST(FaultMotions, OthersAreRefusedWithThoseThatThereAre) {
  try {
    strike("single_leg", FaultKind::kBusOff, "trot");
    FAIL() << "trotted on one leg";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("no motion 'trot' of this robot; there are: standing, comply, crouch"));
  }
}

}  // namespace
}  // namespace sprung
