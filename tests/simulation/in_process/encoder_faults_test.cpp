/// Encoders that fail while their joint works hard (hazards 1 and 7: in a jump's thrust the knee ran into its
/// stop, and damping drove it): how soon it is noticed, how fast the joint gets, and what work the stop does.
/// SPRUNG_SEEDS asks for more seeds than two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"
#include "tests/simulation/in_process/seeds.h"

namespace sprung {
namespace {

using test::order_of;

struct EncoderFault {
  const char* name;
  FaultKind kind;
  double value;
  double within_s;                   ///< noticed, in a thrust and in a trot
  double front_leg_within_s = 0.05;  ///< in a trot, whether its joint moves or not
};

/// Under little torque a stuck encoder is found when the joint has moved by 4 mrad and what its gear gives
/// way, 17 mrad at most (docs/safety.md). A knee in stance takes its time for that.
constexpr double kFar_rad = 0.021;

constexpr EncoderFault kEncoderFaults[] = {
    {"sticks", FaultKind::kEncoderStuck, 0.0, 0.05, 0.1},
    {"jumps", FaultKind::kEncoderJump, 0.5, 0.05},
    {"is_noisy", FaultKind::kEncoderNoise, 0.2, 0.05},
    {"is_a_little_noisy", FaultKind::kEncoderNoise, 0.01, 0.05},
};

struct Noticed {
  double after_s = -1.0;    ///< -1: never
  double moved_rad = 0.0;   ///< the joint, until then: as far as the stack can have been wrong about it
  double peak_rad_s = 0.0;  ///< of any joint, from the fault on, as it truly was
  double driven_J = 0.0;    ///< what its motor put into its motion once it was noticed
  std::string detail;
};

class EncoderInMotion : public testing::TestWithParam<std::tuple<EncoderFault, std::uint64_t>> {
 protected:
  static const EncoderFault& fault() { return std::get<0>(GetParam()); }
  static std::uint64_t seed() { return std::get<1>(GetParam()); }

  static void jump(InProcessRobot& robot) {
    test::stand_up(robot, false);
    robot.submit(order_of(OperatorKind::kJump, 3));
    test::tick_until(robot, MotionPhase::kThrust);
    for (std::uint64_t i = 0; i < 10 * (seed() % 5); ++i) robot.tick();  // somewhere in it
  }

  static void trot(InProcessRobot& robot) {
    test::stand_up(robot, true);
    robot.submit(test::walk_order(3, 0.3, 3));
    for (int i = 0; i < 1500 + 37 * static_cast<int>(seed()); ++i) robot.tick();
    ASSERT_EQ(robot.motion_state().state, MotionPhase::kWalking) << robot.bridge().safety().detail.data();
  }

  /// Makes the fault now and looks for a second.
  static Noticed make_it(InProcessRobot& robot, int actuator, double cycle_s) {
    test::make_fault(robot, actuator, fault().kind, fault().value, 10.0);
    Noticed out;
    const double start_rad = robot.truth().joints[static_cast<std::size_t>(actuator)].true_position_rad;
    for (int i = 0; i < static_cast<int>(1.0 / cycle_s); ++i) {
      robot.tick();
      const std::vector<TrueJoint>& joints = robot.truth().joints;
      for (const TrueJoint& joint : joints)
        out.peak_rad_s = std::max(out.peak_rad_s, std::abs(joint.true_velocity_rad_s));
      const TrueJoint& faulty = joints[static_cast<std::size_t>(actuator)];
      const double power_W = faulty.true_motor_torque_Nm * faulty.true_velocity_rad_s;
      // The torque before it was noticed takes a few cycles to leave the drive.
      if (out.after_s >= 0.0 && i * cycle_s > out.after_s + 0.01)
        out.driven_J += std::max(0.0, power_W) * cycle_s;
      if (out.after_s < 0.0)
        out.moved_rad = std::max(out.moved_rad, std::abs(faulty.true_position_rad - start_rad));
      if (out.after_s < 0.0 && robot.bridge().safety().level != SafetyLevel::kOperational) {
        out.after_s = i * cycle_s;
        out.detail = robot.bridge().safety().detail.data();
      }
    }
    return out;
  }

  /// Prints the figures of docs/measured.md.
  static void expect_noticed(const Noticed& noticed, const ActuatorConfig& drive, double within_s) {
    std::printf("%s: noticed after %.0f ms and %.0f mrad, fastest joint %.1f rad/s, driven %.2f J; %s\n",
                drive.name.c_str(), 1e3 * noticed.after_s, 1e3 * noticed.moved_rad, noticed.peak_rad_s,
                noticed.driven_J, noticed.detail.c_str());
    EXPECT_GE(noticed.after_s, 0.0) << drive.name;
    if (noticed.moved_rad > kFar_rad) {
      EXPECT_LE(noticed.after_s, within_s) << drive.name << ": " << noticed.detail;
    }
    EXPECT_LE(noticed.peak_rad_s, 1.2 * drive.speed_limit_rad_s) << drive.name;
    EXPECT_LE(noticed.driven_J, 1.0) << drive.name;
  }

  static SimOptions seeded() {
    SimOptions sim;
    sim.seed = seed();
    return sim;
  }
};

TEST_P(EncoderInMotion, OfAThrustIsNoticed) {
  const RobotConfig config = load_robot("single_leg");
  for (const int actuator : {0, 1}) {
    InProcessRobot robot(config, "best", seeded());
    jump(robot);
    expect_noticed(make_it(robot, actuator, config.cycle_s), config.actuators[actuator], fault().within_s);
  }
}

TEST_P(EncoderInMotion, OfATrotIsNoticed) {
  const RobotConfig config = load_robot("pegasus");
  for (const int actuator : {1, 2, 8}) {  // a hip, its knee, a hind knee
    InProcessRobot robot(config, "best", seeded());
    trot(robot);
    const Noticed noticed = make_it(robot, actuator, config.cycle_s);
    expect_noticed(noticed, config.actuators[actuator], fault().within_s);
    if (actuator < 3) {
      EXPECT_LE(noticed.after_s, fault().front_leg_within_s) << noticed.detail;
    }
  }
}

std::string fault_and_seed(const testing::TestParamInfo<EncoderInMotion::ParamType>& one) {
  return std::string(std::get<0>(one.param).name) + "_seed_" + std::to_string(std::get<1>(one.param));
}

INSTANTIATE_TEST_SUITE_P(Seeds, EncoderInMotion,
                         testing::Combine(testing::ValuesIn(kEncoderFaults),
                                          testing::Range<std::uint64_t>(1, 1 + test::seeds())),
                         fault_and_seed);

}  // namespace
}  // namespace sprung
