#pragma once
/// What was identified, as keys of robot.yaml. Pure but for short_sha256().
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/identify/identified_joint.h"
#include "tools/lab/identify/law_uncertainty.h"

namespace sprung::identify {

/// The joint as robot.yaml will hold it: `known` with armature, friction and their uncertainty as found.
/// @param known of robot.yaml, or a joint with a name alone. @param days on which the law is to hold. Where
/// the room's temperature is known and the law tells warmth, the joint's `thermal` is set too.
/// @throws std::invalid_argument where the torque is in amperes: robot.yaml wants Nm.
JointConfig identified_config(const IdentifiedJoint& joint, const JointConfig& known,
                              const Provenance& provenance, const OtherDays& days = {});

/// The torque constant of the joint's actuator over robot.yaml's, where the recordings have weighed it: the
/// config above goes with it.
std::optional<TorqueConstant> corrected_torque_constant(const IdentifiedJoint& joint);

/// A list entry under `joints:` for each, with comments that say what else was found.
std::string fragment_text(const std::vector<IdentifiedJoint>& joints,
                          const std::vector<JointConfig>& configs);

/// Which files exactly: the first 16 hexadecimal digits of the SHA-256 of all of them, one after the other.
/// @throws std::runtime_error when one cannot be read.
std::string short_sha256(const std::vector<std::string>& paths);

}  // namespace sprung::identify
