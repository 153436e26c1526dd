#pragma once
/// Motor side of a gear with torsion: the rotor as a mass of its own (facts physics 10), friction on it, and
/// a spring with two stiffnesses and a damper to the link. Pure. All on the output side of the ratio.
/// Sign: positive output torque accelerates the link toward +q and the rotor toward -q.
#include "simulation/plant/joint_config.h"

namespace sprung::sim {

class ElasticGear {
 public:
  ElasticGear(const TorsionConfig& torsion, double armature_kg_m2) noexcept;

  /// At rest with the spring relaxed.
  void reset(double link_rad) noexcept;
  /// What the gear exerts on the link now.
  double output_torque_Nm(double link_rad, double link_rad_s) const noexcept;
  /// The rotor's part of a semi-implicit Euler step: speeds with the torques of the step's begin, then
  /// positions with the new speeds, as MuJoCo does with the link; so spring and masses exchange energy and
  /// gain none. Friction is implicit: dry friction stops the rotor exactly, and holds it exactly.
  /// @param output_torque_Nm that acted on the link in this step.
  void step(double motor_torque_Nm, double output_torque_Nm, double dry_Nm, double viscous_Nm_s_rad,
            double dt_s) noexcept;

  double position_rad() const noexcept { return position_rad_; }
  double velocity_rad_s() const noexcept { return velocity_rad_s_; }
  /// Dry and viscous, and dry alone, in the last step; sign of motion.
  double friction_torque_Nm() const noexcept { return dry_friction_Nm_ + viscous_friction_Nm_; }
  double dry_friction_Nm() const noexcept { return dry_friction_Nm_; }

 private:
  TorsionConfig torsion_;
  double armature_kg_m2_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  double dry_friction_Nm_ = 0.0;
  double viscous_friction_Nm_ = 0.0;
};

}  // namespace sprung::sim
