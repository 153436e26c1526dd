#pragma once
/// sim.yaml's `joints`: what the plant's gears are truly like. Start-up only. Sources of the numbers stand in
/// sim.yaml.
#include <optional>
#include <string>

#include "robots/yaml_reader.h"

namespace sprung::sim {

/// Factor on viscous friction by temperature T: exp(-per_K (T - reference)) (facts papers D2: 0.03-0.04 / K);
/// on Coulomb and breakaway friction the share `coulomb_share` of them falls so, the rest stays.
struct FrictionTemperatureConfig {
  double per_K = 0.0;
  double reference_degC = 24.0;  ///< where sim.yaml's values hold
  double coulomb_share = 0.0;
};

/// Teeth that are not all alike: a factor 1 + share sin(order angle + phase) on dry friction.
struct RippleConfig {
  double share = 0.0;
  double order = 2.0;  ///< per turn; a wave generator has two lobes
  double phase_rad = 0.0;
};

/// Friction of one joint, output side; L is the gear output torque, w the speed of the motor side:
/// (1 + asymmetry sgn w) (coulomb + (breakaway - coulomb) exp(-(w / stribeck_speed)^2) + share |L| + viscous
/// |w|) against the motion. `share` is driving_share where the gear drives the link (L w > 0),
/// back_driving_share where the link drives the gear (facts papers D1). Dry friction, all but viscous, has
/// the ripples as factors (facts papers D10), and holds elastically where there is presliding (presliding.h).
struct FrictionConfig {
  double coulomb_Nm = 0.0;
  double breakaway_Nm = 0.0;
  double stribeck_speed_rad_s = 1.0;
  double viscous_Nm_s_rad = 0.0;
  double driving_share = 0.0;
  double back_driving_share = 0.0;
  double asymmetry = 0.0;
  FrictionTemperatureConfig temperature;
  RippleConfig motor_ripple;    ///< by the motor's angle
  RippleConfig joint_ripple;    ///< by the joint's
  double presliding_rad = 0.0;  ///< from rest until it slides, without load; 0 = it holds rigidly
};

/// dT/dt = (friction loss * resistance - (T - ambient)) / time_constant (facts papers D2). A resistance of 0
/// is a gear that stays at the ambient temperature.
struct ThermalConfig {
  double resistance_K_W = 0.0;
  double time_constant_s = 1.0;
};

/// Spring between motor side and link: stiffness up to second_from_Nm, second_stiffness beyond, both behind
/// the play of the teeth. In the play the gear transmits nothing, nor does its damper.
struct TorsionConfig {
  double stiffness_Nm_rad = 0.0;
  double second_stiffness_Nm_rad = 0.0;
  double second_from_Nm = 0.0;
  double damping_Nm_s_rad = 0.0;
  double backlash_rad = 0.0;  ///< from one flank to the other
};

struct PlantJointConfig {
  std::string name;                 ///< of the joint in robot.yaml and in model.xml
  double initial_rad = 0.0;         ///< pose before cycle 0 and after a reset
  std::optional<double> lying_rad;  ///< the same when the robot lies on the floor
  double armature_kg_m2 = 0.0;      ///< ratio^2 * inertia of rotor and wave generator
  double stop_min_rad = 0.0;        ///< mechanical end stops
  double stop_max_rad = 0.0;
  FrictionConfig friction;
  ThermalConfig thermal;
  std::optional<TorsionConfig> torsion;  ///< none: motor side and link move as one
};

/// @throws ConfigError
PlantJointConfig read_plant_joint(const YamlMap& map);

}  // namespace sprung::sim
