#pragma once
/// How hard a leg's motors can brake a foot that falls: they turn their rotors, and what friction takes is
/// not left for that (9 Nm s/rad at 6 rad/s: 54 of 171 Nm). Pure; no heap after construction.
#include <memory>
#include <vector>

#include "model/friction/friction_parameters.h"
#include "model/leg_kinematics.h"
#include "model/transmission.h"
#include "planner/foot_fall.h"
#include "robots/robot_config.h"

namespace sprung {

class BrakingLimit {
 public:
  /// @throws std::invalid_argument on kinematics or a transmission that cannot be.
  BrakingLimit(const RobotConfig& robot, const LegConfig& leg);

  /// The hardest, of a few between a third of what is wished and all of it, that the motors can follow by
  /// robot.yaml's model; a third where they can follow none. @param fall that has just begun.
  double most_braking_m_s2(const FootFall& fall, double wished_m_s2) const noexcept;

 private:
  bool can_follow(FootFall fall) const noexcept;
  /// Joint side: rotors, links and friction, the hip falling freely.
  JointVector torque_Nm(const FootPoint& foot, const JointVector& position_rad) const noexcept;

  std::shared_ptr<const LegKinematics> kinematics_;  ///< without state: copies share it
  Transmission transmission_;
  JointVector middle_rad_, armature_kg_m2_;
  JointVector limit_Nm_;  ///< of the actuators
  std::vector<FrictionParameters> friction_;
};

}  // namespace sprung
