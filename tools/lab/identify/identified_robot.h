#pragma once
/// A robot's files with what was identified in them. Reads and writes files, but for with_identified().
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/identify/identified_joint.h"
#include "tools/lab/identify/law_uncertainty.h"

namespace sprung::identify {

/// What goes into robot.yaml: one joint, and its actuator's torque constant where that was weighed.
struct RobotChange {
  JointConfig joint;
  std::string actuator;  ///< empty: what follows stays
  double torque_constant_Nm_A = 0.0;
  double torque_limit_Nm = 0.0;  ///< as it was, or less: the motor's peak current does not grow
};

/// Of one identified joint. @param days as identified_config(). @throws std::invalid_argument as that.
RobotChange change_of(const RobotConfig& robot, const IdentifiedJoint& joint, const Provenance& provenance,
                      const OtherDays& days = {});

/// The text of robot.yaml, typed out, with these changes. @param yaml as it stands. @param name stands for
/// its path in messages. @throws ConfigError where the file is none, or lacks a joint or actuator.
std::string with_identified(const std::string& yaml, const std::string& name,
                            const std::vector<RobotChange>& changes);

/// A copy of the robot's folder whose robot.yaml has these changes. @throws std::runtime_error where the
/// folder holds a robot already or cannot be written.
void write_identified_robot(const RobotConfig& robot, const std::vector<RobotChange>& changes,
                            const std::string& folder);

}  // namespace sprung::identify
