#include "simulation/plant/experimenter.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

class ExperimenterTest : public testing::Test {
 protected:
  static SimControl make(SimControlKind kind, std::int64_t at, int actuator = -1, double value = 0.0) {
    SimControl control;
    control.kind = kind;
    control.apply_at_seq = at;
    control.actuator = actuator;
    control.value = value;
    return control;
  }
  double foot_x() {
    SimTruth truth(2, 1);
    train_.plant().fill_truth(truth);
    return truth.legs[0].true_foot_in_world_m[0];
  }
  void run(int steps) {
    while (steps-- > 0) {
      train_.step_plant();
      experimenter_.after_step();
    }
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/single_leg");
  DriveTrain train_{robot_, load_sim_config(robot_, {}), 1};
  BusFaults buses_{1};
  ImuSensor imu_{ImuConfig{}, 1};
  Experimenter experimenter_{train_, buses_, imu_};
};

SimControl fault(FaultKind kind, int actuator, int bus, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.fault = kind;
  control.actuator = actuator;
  control.bus = bus;
  control.duration_s = duration_s;
  return control;
}

TEST_F(ExperimenterTest, FaultOfANodeEndsAfterItsTime) {
  experimenter_.add(fault(FaultKind::kLinkDown, 1, -1, 0.01));
  experimenter_.start_cycle(0);
  EXPECT_TRUE(train_.drive(1)->outbox().cut());
  EXPECT_FALSE(train_.drive(0)->outbox().cut());
  run(39);
  EXPECT_TRUE(train_.drive(1)->outbox().cut());
  run(1);
  EXPECT_FALSE(train_.drive(1)->outbox().cut());
}

TEST_F(ExperimenterTest, FaultOfABusHitsItsNodesAndTheMaster) {
  experimenter_.add(fault(FaultKind::kBusOff, -1, 0, 0.01));
  experimenter_.start_cycle(0);
  EXPECT_TRUE(train_.drive(0)->outbox().cut() && train_.drive(1)->outbox().cut());
  run(40);
  EXPECT_FALSE(train_.drive(0)->outbox().cut() || train_.drive(1)->outbox().cut());
  FrameBatch out;
  buses_.report(out);
  EXPECT_EQ(out.size(), 2);  // bus off, restarted
}

TEST_F(ExperimenterTest, FaultWithoutDurationStandsUntilItIsMended) {
  experimenter_.add(fault(FaultKind::kLinkDown, 0, -1, 0.0));
  experimenter_.add(fault(FaultKind::kLinkDown, 1, -1, 0.0));
  experimenter_.start_cycle(0);
  run(4000);
  EXPECT_TRUE(train_.drive(0)->outbox().cut());
  experimenter_.add(fault(FaultKind::kNone, 0, -1, 0.0));
  experimenter_.start_cycle(1);
  EXPECT_FALSE(train_.drive(0)->outbox().cut());
  EXPECT_TRUE(train_.drive(1)->outbox().cut());
}

TEST_F(ExperimenterTest, SameFaultAgainBeginsAnew) {
  experimenter_.add(fault(FaultKind::kLinkDown, 0, -1, 0.01));
  experimenter_.start_cycle(0);
  run(30);
  experimenter_.add(fault(FaultKind::kLinkDown, 0, -1, 0.01));
  experimenter_.start_cycle(1);
  run(39);
  EXPECT_TRUE(train_.drive(0)->outbox().cut());
  run(1);
  EXPECT_FALSE(train_.drive(0)->outbox().cut());
}

TEST_F(ExperimenterTest, FaultsAtWorkCountAgainstTheLimit) {
  const int capacity = static_cast<int>(Experimenter::kCapacity);
  for (int i = 0; i < capacity; ++i)
    ASSERT_TRUE(experimenter_.add(fault(FaultKind::kEncoderStuck, i, -1, 0.01)));
  experimenter_.start_cycle(0);
  EXPECT_FALSE(experimenter_.add(fault(FaultKind::kEncoderStuck, 0, -1, 0.0)));
  run(40);
  EXPECT_TRUE(experimenter_.add(fault(FaultKind::kEncoderStuck, 0, -1, 0.0)));
}

TEST_F(ExperimenterTest, WaitsForItsCycle) {
  experimenter_.add(make(SimControlKind::kDriveFault, 5, 1));
  experimenter_.start_cycle(4);
  EXPECT_NE(train_.drive(1)->power_state(), PowerState::kFaultReactionActive);
  experimenter_.start_cycle(5);
  EXPECT_EQ(train_.drive(1)->power_state(), PowerState::kFaultReactionActive);
}

TEST_F(ExperimenterTest, PushesAFootForItsTimeOnly) {
  experimenter_.add(make(SimControlKind::kSuspend, 0, -1, 1.0));
  experimenter_.start_cycle(0);
  run(4000);
  SimControl pull = make(SimControlKind::kWrench, 1, 0);
  pull.wrench = {60, 0, 0, 0, 0, 0};
  pull.duration_s = 0.1;
  experimenter_.add(pull);
  experimenter_.start_cycle(1);
  const double before_m = foot_x();
  run(400);
  const double pulled_m = foot_x();
  EXPECT_GT(pulled_m, before_m + 0.01);
  run(4000);  // friction stops it
  const double stopped_m = foot_x();
  run(400);
  EXPECT_NEAR(foot_x(), stopped_m, 1e-4);
}

TEST_F(ExperimenterTest, PushThatGrowsBeginsSmallAndGoesOnFromThePushThatIsThere) {
  experimenter_.add(make(SimControlKind::kSuspend, 0, -1, 1.0));
  experimenter_.start_cycle(0);
  run(4000);
  SimControl pull = make(SimControlKind::kWrench, 1, 0, 0.2);
  pull.wrench = {60, 0, 0, 0, 0, 0};
  pull.duration_s = 0.3;
  experimenter_.add(pull);
  experimenter_.start_cycle(1);
  const double before_m = foot_x();
  run(80);  // a tenth of the force: friction holds
  EXPECT_NEAR(foot_x(), before_m, 1e-4);
  run(720);
  const double pulled_m = foot_x();
  EXPECT_GT(pulled_m, before_m + 0.003);
  pull.value = 10.0;  // grows from 60 to 60 N: at full strength at once
  experimenter_.add(pull);
  experimenter_.start_cycle(2);
  run(400);
  EXPECT_GT(foot_x(), pulled_m + 0.01);
}

TEST_F(ExperimenterTest, FloorMovesToItsHeightAndAResetPutsItBack) {
  const double standing_m = train_.plant().position_rad(0);
  experimenter_.add(make(SimControlKind::kFloor, 0, -1, -10.0));
  experimenter_.start_cycle(0);
  run(400);
  SimTruth falling(2, 1);
  train_.plant().fill_truth(falling);
  EXPECT_LT(falling.base_velocity_m_s[2], -0.9) << "0.1 s of free fall";
  experimenter_.add(make(SimControlKind::kReset, 1));
  experimenter_.start_cycle(1);
  EXPECT_EQ(train_.plant().position_rad(0), standing_m);
  run(40);
  SimTruth truth(2, 1);
  train_.plant().fill_truth(truth);
  EXPECT_GT(truth.legs[0].true_contact_force_N[2], 10.0);
}

TEST_F(ExperimenterTest, WhatDoesNotExistIsIgnored) {
  experimenter_.add(make(SimControlKind::kDriveFault, 0, 7));
  experimenter_.add(make(SimControlKind::kDriveSilent, 0, -1, 1.0));
  SimControl push = make(SimControlKind::kWrench, 0, 9);
  push.duration_s = 1.0;
  experimenter_.add(push);
  experimenter_.start_cycle(0);
  run(10);
  EXPECT_FALSE(train_.plant().failed());
}

TEST_F(ExperimenterTest, KeepsALimitedNumber) {
  for (std::size_t i = 0; i < Experimenter::kCapacity; ++i) {
    ASSERT_TRUE(experimenter_.add(make(SimControlKind::kReset, 100)));
  }
  EXPECT_FALSE(experimenter_.add(make(SimControlKind::kReset, 100)));
  experimenter_.start_cycle(100);
  EXPECT_TRUE(experimenter_.add(make(SimControlKind::kReset, 100)));
}

TEST_F(ExperimenterTest, ResetEndsPushAndSuspension) {
  experimenter_.add(make(SimControlKind::kSuspend, 0, -1, 1.0));
  SimControl push = make(SimControlKind::kWrench, 0);
  push.wrench = {0, 0, 500, 0, 0, 0};
  push.duration_s = 10.0;
  experimenter_.add(push);
  experimenter_.add(make(SimControlKind::kReset, 0));
  experimenter_.start_cycle(0);
  run(40);
  SimTruth truth(2, 1);
  train_.plant().fill_truth(truth);
  EXPECT_LT(truth.base_in_world_m[2], 0.33);
  EXPECT_LT(truth.base_velocity_m_s[2], 0.0);  // sags
}

/// Of a robot with a trunk and several legs.
class BodyExperimenterTest : public testing::Test {
 protected:
  void run(double seconds) {
    for (long i = std::lround(seconds / train_.plant().step_s()); i > 0; --i) {
      train_.step_plant();
      experimenter_.after_step();
    }
    train_.plant().fill_truth(truth_);
  }
  void act(const SimControl& control) {
    experimenter_.add(control);
    experimenter_.start_cycle(0);
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/pegasus");
  DriveTrain train_{robot_, load_sim_config(robot_, {{"suspended", 0.8}}), 1};
  BusFaults buses_{4};
  ImuSensor imu_{ImuConfig{}, 1};
  Experimenter experimenter_{train_, buses_, imu_};
  SimTruth truth_{12, 4};
};

TEST_F(BodyExperimenterTest, PushOnTheTrunkGivesTheImpulseThatWasAskedForAndEnds) {
  SimControl drop;
  drop.kind = SimControlKind::kSuspend;
  drop.value = 0.0;
  act(drop);
  SimControl push;
  push.kind = SimControlKind::kWrench;
  push.wrench = {0, 300, 0, 0, 0, 0};
  push.duration_s = 0.1;
  act(push);
  run(0.05);
  EXPECT_NEAR(30.0 * truth_.com_velocity_m_s[1], 15.0, 0.01);  // N s
  run(0.1);
  EXPECT_NEAR(30.0 * truth_.com_velocity_m_s[1], 30.0, 0.01);
}

TEST_F(BodyExperimenterTest, FloorRisesUnderOneLegAlone) {
  SimControl floor;
  floor.kind = SimControlKind::kFloor;
  floor.actuator = 3;
  floor.value = 0.02;
  act(floor);
  run(0.001);
  EXPECT_EQ(truth_.legs[3].true_ground_height_m, 0.02);
  EXPECT_EQ(truth_.legs[2].true_ground_height_m, 0.0);
  floor.actuator = -1;
  floor.value = 0.01;
  act(floor);
  run(0.001);
  for (const TrueLeg& leg : truth_.legs) EXPECT_EQ(leg.true_ground_height_m, 0.01);
}

TEST_F(BodyExperimenterTest, ImuIsSilencedAndForgetsItsMotionOnAReset) {
  const auto sample = [&](std::int64_t cycle) {
    imu_.sample(train_.plant().base_motion(), {2000 * cycle, cycle}, 0.002 * static_cast<double>(cycle));
  };
  sample(0);
  sample(1);
  SimControl silence;
  silence.kind = SimControlKind::kImu;
  silence.value = 1.0;
  act(silence);
  sample(2);
  EXPECT_EQ(imu_.newest().stamp.seq, 1);
  silence.value = 0.0;
  act(silence);
  SimControl reset;
  reset.kind = SimControlKind::kReset;
  act(reset);
  sample(3);
  EXPECT_EQ(imu_.newest().stamp.seq, 3);
  EXPECT_EQ(imu_.newest().status, ImuStatus::kStarting);
}

}  // namespace
}  // namespace sprung::sim
