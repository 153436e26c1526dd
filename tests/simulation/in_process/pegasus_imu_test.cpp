/// The IMU of pegasus in a whole robot: hanging, so at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {
namespace {

class PegasusImu : public testing::Test {
 protected:
  void start(const SimOptions& options) {
    robot_.emplace(config_, "best", options);
    robot_->boot();
  }
  void run(int cycles) {
    while (cycles-- > 0) robot_->tick();
  }
  const Imu& imu() { return robot_->sim().imu(); }
  void control_imu(double value) {
    SimControl control;
    control.kind = SimControlKind::kImu;
    control.value = value;
    robot_->sim().control(control);
  }
  RobotConfig config_ = load_robot("pegasus");
  std::optional<InProcessRobot> robot_;
};

TEST_F(PegasusImu, AtRestReadsGravityUpwardLevelAndStill) {
  start({});
  run(500);
  EXPECT_EQ(imu().stamp.seq, robot_->cycle());
  EXPECT_EQ(imu().status, ImuStatus::kGood);
  EXPECT_NEAR(imu().measured_specific_force_m_s2[2], 9.81, 0.3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(imu().measured_angular_velocity_rad_s[i], 0.0, 0.03);
  EXPECT_GT(imu().measured_quaternion_wxyz[0], 0.9995);
}

TEST_F(PegasusImu, IsASampleOfEveryCycleFromTheSecondOn) {
  start({});
  EXPECT_EQ(imu().stamp.seq, 0);
  EXPECT_EQ(imu().status, ImuStatus::kStarting);
  for (int k = 1; k < 20; ++k) {
    run(1);
    ASSERT_EQ(imu().stamp.seq, k);
    ASSERT_EQ(imu().status, ImuStatus::kGood);
  }
}

TEST_F(PegasusImu, FallsSilentAndComesBackByControl) {
  start({});
  run(10);
  control_imu(1.0);
  run(5);
  EXPECT_EQ(imu().stamp.seq, 10);
  control_imu(0.0);
  run(5);
  EXPECT_EQ(imu().stamp.seq, robot_->cycle());
}

TEST_F(PegasusImu, IsNotThereWhereThePlantHasNone) {
  SimOptions options;
  options.plant["imu"] = 0.0;
  start(options);
  run(10);
  EXPECT_EQ(imu().stamp.seq, -1);
}

TEST_F(PegasusImu, HasTheSameBitsWithAndWithoutTruthAndOthersWithAnotherSeed) {
  std::vector<double> read[3];
  for (int i = 0; i < 3; ++i) {
    SimOptions options;
    options.plant["suspended"] = 0.0;  // it falls
    options.truth = i != 1;
    options.seed = i == 2 ? 9 : 1;
    start(options);
    for (int k = 0; k < 200; ++k) {
      run(1);
      for (const double value : imu().measured_specific_force_m_s2) read[i].push_back(value);
      for (const double value : imu().measured_quaternion_wxyz) read[i].push_back(value);
    }
  }
  EXPECT_EQ(read[0], read[1]);
  EXPECT_NE(read[0], read[2]);
}

}  // namespace
}  // namespace sprung
