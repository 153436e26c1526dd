/// The estimated trunk against the simulation's truth: pegasus on its virtual springs, pushed, with an IMU
/// and without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "estimator/rotation.h"
#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {
namespace {

struct BodyErrors {
  double tilt_deg = 0.0;      ///< worst
  double imu_tilt_deg = 0.0;  ///< the same of the IMU's own attitude
  double velocity_m_s = 0.0;  ///< rms
  double height_m = 0.0;      ///< worst
  double moved_m_s = 0.0;     ///< fastest true speed
};

Eigen::Quaterniond quaternion(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

class BodyEstimateOfPegasus : public testing::Test {
 protected:
  /// On its feet, each on a virtual spring.
  void comply(std::map<std::string, double> plant = {}) {
    robot_ = std::make_unique<InProcessRobot>(config_, "best", SimOptions{2, std::move(plant), true});
    robot_->boot();
    run(0.2);
    ask(OperatorKind::kHome, 0.3);
    ask(OperatorKind::kStand, 2.5);  // still hanging
    control(SimControlKind::kSuspend, 0.0);
    run(1.5);
    ask(OperatorKind::kComply, 1.0);
    ASSERT_EQ(robot_->motion_state().state, MotionPhase::kComplying);
  }
  void ask(OperatorKind kind, double then_s) {
    OperatorCommand command;
    command.kind = kind;
    command.request_id = ++requests_;
    robot_->submit(command);
    run(then_s);
    OperatorReply reply;
    while (robot_->next_reply(reply)) EXPECT_NE(reply.outcome, OperatorOutcome::kRefused) << reply.reason;
  }
  void control(SimControlKind kind, double value, const std::array<double, 6>& wrench = {},
               double duration_s = 0.0) {
    SimControl control;
    control.kind = kind;
    control.value = value;
    control.wrench = wrench;
    control.duration_s = duration_s;
    control.apply_at_seq = robot_->cycle() + 1;
    robot_->sim().control(control);
  }
  const EstimatedBody& body() const { return robot_->joint_state().body; }

  /// Over the feet that truly carry something.
  double true_height_m() const {
    const SimTruth& truth = robot_->truth();
    double sum_m = 0.0;
    int feet = 0;
    for (const TrueLeg& leg : truth.legs) {
      if (leg.true_contact_force_N[2] < 5.0) continue;
      sum_m += truth.base_in_world_m[2] - leg.true_foot_in_world_m[2];
      ++feet;
    }
    return sum_m / feet;
  }
  static double tilt_error_deg(const Eigen::Quaterniond& seen, const Eigen::Quaterniond& truth) {
    const Eigen::Vector3d up = truth.conjugate() * Eigen::Vector3d::UnitZ();
    return std::acos(std::min(1.0, (seen * up).z())) * 180.0 / M_PI;
  }
  BodyErrors run(double duration_s) {
    BodyErrors errors;
    const int cycles = static_cast<int>(std::lround(duration_s / config_.cycle_s));
    for (int k = 0; k < cycles; ++k) {
      robot_->tick();
      const Eigen::Quaterniond truth = quaternion(robot_->truth().base_quaternion_wxyz);
      const Eigen::Quaterniond estimate = quaternion(body().estimated_quaternion_wxyz);
      const Eigen::Quaterniond imu = quaternion(robot_->sim().imu().measured_quaternion_wxyz);
      const Eigen::Vector3d velocity_m_s = truth.conjugate() * to_eigen(robot_->truth().base_velocity_m_s);
      errors.tilt_deg = std::max(errors.tilt_deg, tilt_error_deg(estimate, truth));
      errors.imu_tilt_deg = std::max(errors.imu_tilt_deg, tilt_error_deg(imu, truth));
      errors.velocity_m_s += (to_eigen(body().estimated_velocity_m_s) - velocity_m_s).squaredNorm() / cycles;
      errors.height_m = std::max(errors.height_m, std::abs(body().estimated_height_m - true_height_m()));
      errors.moved_m_s = std::max(errors.moved_m_s, velocity_m_s.norm());
    }
    errors.velocity_m_s = std::sqrt(errors.velocity_m_s);
    return errors;
  }
  /// 15 N s sideways, then forward.
  BodyErrors push() {
    control(SimControlKind::kWrench, 0.0, {0, 150, 0, 0, 0, 0}, 0.1);
    const BodyErrors sideways = run(0.5);
    control(SimControlKind::kWrench, 0.0, {150, 0, 0, 0, 0, 0}, 0.1);
    const BodyErrors forward = run(0.5);
    return {std::max(sideways.tilt_deg, forward.tilt_deg),
            std::max(sideways.imu_tilt_deg, forward.imu_tilt_deg),
            std::max(sideways.velocity_m_s, forward.velocity_m_s),
            std::max(sideways.height_m, forward.height_m), std::min(sideways.moved_m_s, forward.moved_m_s)};
  }

  RobotConfig config_ = load_robot("pegasus");
  std::unique_ptr<InProcessRobot> robot_;
  std::int64_t requests_ = 0;
};

/// The sensor's own bias is not known to the estimator: 0.45 degrees on this seed.
TEST_F(BodyEstimateOfPegasus, PushedWithAnImuTiltIsAsGoodAsTheSensor) {
  comply();
  const BodyErrors errors = push();
  EXPECT_TRUE(body().uses_imu);
  EXPECT_GT(errors.moved_m_s, 0.2);
  EXPECT_LT(errors.imu_tilt_deg, 0.7);
  EXPECT_LT(errors.tilt_deg, errors.imu_tilt_deg + 0.02);
  EXPECT_LT(errors.velocity_m_s, 0.03);
  EXPECT_LT(errors.height_m, 0.005);
}

/// A standing foot whose contact is not seen leaves two or three to tell the tilt, which is then held where
/// they do not.
TEST_F(BodyEstimateOfPegasus, PushedWithoutAnImuOnALevelFloorTiltIsKnownToThreeDegrees) {
  comply({{"imu", 0.0}});
  const BodyErrors errors = push();
  EXPECT_FALSE(body().uses_imu);
  EXPECT_GT(errors.moved_m_s, 0.2);
  EXPECT_LT(errors.tilt_deg, 3.0);
  EXPECT_LT(errors.velocity_m_s, 0.06);
  EXPECT_LT(errors.height_m, 0.010);
}

TEST_F(BodyEstimateOfPegasus, ImuThatFailsInAPushIsReplacedByTheFeetAndTakenAgain) {
  comply();
  control(SimControlKind::kImu, 2.0);
  run(config_.cycle_s * 2);
  EXPECT_FALSE(body().uses_imu);
  EXPECT_LT(push().tilt_deg, 3.0);
  control(SimControlKind::kImu, 3.0);
  EXPECT_LT(push().tilt_deg, 3.0);
  EXPECT_TRUE(body().uses_imu);
  control(SimControlKind::kImu, 0.0);
  run(1.0);
  const BodyErrors errors = push();
  EXPECT_LT(errors.tilt_deg, errors.imu_tilt_deg + 0.05);
  const Eigen::Quaterniond truth = quaternion(robot_->truth().base_quaternion_wxyz);
  EXPECT_NEAR(yaw_rad(quaternion(body().estimated_quaternion_wxyz)), yaw_rad(truth), 0.02);
}

}  // namespace
}  // namespace sprung
