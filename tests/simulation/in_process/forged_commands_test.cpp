/// DRIVE_COMMANDs that no healthy controller sends (hazards 2 and 14: a forged one swept the hip to its stop
/// and beyond at 12 rad/s, and nothing was refused): what the last gate makes of them, seen by the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

struct Forgery {
  const char* robot;
  const char* name;
  DriveMode mode;
  double torque_share;  ///< of the limit
  double swing_cycles;  ///< it changes sign after so many; 0: never
  double position_rad;
};

std::string forgery_name(const testing::TestParamInfo<Forgery>& info) {
  return std::string(info.param.robot) + "_" + info.param.name;
}

class ForgedCommands : public testing::TestWithParam<Forgery> {
 protected:
  struct Seen {
    double beyond_rad = 0.0;     ///< largest, of a joint beyond its limits
    double fastest_share = 0.0;  ///< of its actuator's speed limit, for 20 ms and more
    std::string detail;
    SafetyLevel level = SafetyLevel::kOperational;
  };

  static void forge(const RobotConfig& config, DriveCommand& command) {
    const Forgery& forgery = GetParam();
    const bool back = forgery.swing_cycles > 0 &&
                      std::fmod(command.stamp.seq, 2 * forgery.swing_cycles) >= forgery.swing_cycles;
    for (std::size_t i = 0; i < config.actuators.size(); ++i) {
      ActuatorCommand& out = command.actuators[i];
      if (out.mode == DriveMode::kDisabled) continue;
      out.mode = forgery.mode;
      out.commanded_torque_Nm = (back ? -1 : 1) * forgery.torque_share * config.actuators[i].torque_limit_Nm;
      out.commanded_position_rad = (back ? -1 : 1) * forgery.position_rad;
    }
  }

  static void look(const RobotConfig& config, const InProcessRobot& robot, std::vector<int>& fast,
                   Seen& seen) {
    const int long_enough = static_cast<int>(std::lround(0.02 / config.cycle_s));
    for (std::size_t j = 0; j < config.joints.size(); ++j) {
      const TrueJoint& joint = robot.truth().joints[j];
      seen.beyond_rad = std::max({seen.beyond_rad,
                                  config.joints[j].position_min_rad - joint.true_position_rad,
                                  joint.true_position_rad - config.joints[j].position_max_rad});
      const double share = std::abs(joint.true_velocity_rad_s) / config.actuators[j].speed_limit_rad_s;
      fast[j] = share > 1.2 ? fast[j] + 1 : 0;
      if (fast[j] >= long_enough) seen.fastest_share = std::max(seen.fastest_share, share);
    }
  }
};

TEST_P(ForgedCommands, MoveNothingFarBeyondItsLimitsNorFasterThanItMay) {
  const RobotConfig config = load_robot(GetParam().robot);
  SimOptions sim;
  sim.seed = 7;
  InProcessRobot robot(config, "best", sim);
  test::stand_up(robot, !config.actuators[0].referenced);
  robot.forge_commands_by([&](DriveCommand& command) { forge(config, command); });
  Seen seen;
  std::vector<int> fast(config.joints.size());
  for (int i = 0; i < static_cast<int>(2.0 / config.cycle_s); ++i) {
    robot.tick();
    look(config, robot, fast, seen);
    if (severity(robot.bridge().safety().level) > severity(seen.level)) {
      seen.level = robot.bridge().safety().level;
      seen.detail = robot.bridge().safety().detail.data();
    }
  }
  std::printf("beyond %.3f rad, fastest %.2f of its limit; %s\n", seen.beyond_rad, seen.fastest_share,
              seen.detail.c_str());
  EXPECT_TRUE(seen.beyond_rad <= 0.06 || seen.level != SafetyLevel::kOperational);
  EXPECT_LE(seen.beyond_rad, 0.12) << "a stop of rubber, and what it takes to stop";
  EXPECT_LE(seen.fastest_share, 1.3);
}

const Forgery kForgeries[] = {
    {"single_leg", "full_torque", DriveMode::kTorque, 0.99, 0, 0},
    {"single_leg", "full_torque_back", DriveMode::kTorque, -0.99, 0, 0},
    {"single_leg", "torque_to_and_fro", DriveMode::kTorque, 0.99, 150, 0},
    {"single_leg", "position_out_of_reach", DriveMode::kPosition, 0, 0, 12},
    {"single_leg", "position_to_and_fro", DriveMode::kPosition, 0, 150, 3},
    {"pegasus", "full_torque", DriveMode::kTorque, 0.99, 0, 0},
    {"pegasus", "torque_to_and_fro", DriveMode::kTorque, 0.99, 100, 0},
    {"pegasus", "position_out_of_reach", DriveMode::kPosition, 0, 0, 12},
};
INSTANTIATE_TEST_SUITE_P(Hazard2, ForgedCommands, testing::ValuesIn(kForgeries), forgery_name);

}  // namespace
}  // namespace sprung
