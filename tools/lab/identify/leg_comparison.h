#pragma once
/// What robot.yaml's links say about an identified joint: their share of the inertia, and whether the weight
/// that was found is theirs. Pure.
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// @param pose_rad of the joints of the joint's leg. Nothing for joints without kinematics: no motion tells
/// rotor from link.
std::optional<Armature> armature_of(const RobotConfig& robot, int joint, const std::vector<double>& pose_rad,
                                    const identification::ModelResult& model);

/// What a weight at the foot that is known tells. Driving it a motor gives gain (1 + share), driven by it
/// gain (1 - share): two numbers for a gain and the shares of two directions. Which part of their difference
/// is the torque constant's no weight tells, so both directions are taken to have one share; published gears
/// differ by 0.02 (facts C4).
struct Weighed {
  TorqueConstant torque_constant;
  double load_share = 0.0;
};
/// Nothing where no weight was fitted with a gain.
std::optional<Weighed> weighed(const identification::ModelResult& model);

/// The same, or else from the links' weight alone, as if robot.yaml's masses were right. Nothing without
/// kinematics, or where the weight is smaller than 1 Nm or than five of its standard errors.
std::optional<TorqueConstant> torque_constant_of(const RobotConfig& robot, int joint,
                                                 const std::vector<double>& pose_rad,
                                                 const identification::ModelResult& model);

}  // namespace sprung::identify
