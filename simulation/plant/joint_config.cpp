#include "simulation/plant/joint_config.h"

namespace sprung::sim {
namespace {

/// One share for both directions of power, or one for each.
void read_load_shares(const YamlMap& map, FrictionConfig& friction) {
  if (map.has("driving_share") || map.has("back_driving_share")) {
    friction.driving_share = map.quantity("driving_share", "", 0, 0.9);
    friction.back_driving_share = map.quantity("back_driving_share", "", 0, 0.9);
  } else {
    friction.driving_share = friction.back_driving_share = map.quantity("load_share", "", 0, 0.9);
  }
}

FrictionTemperatureConfig read_temperature(const YamlMap& map) {
  FrictionTemperatureConfig temperature;
  temperature.per_K = map.quantity("coefficient", "1/K", 0, 0.2);
  temperature.reference_degC = map.quantity("reference", "degC", -50, 150);
  temperature.coulomb_share = map.quantity_or("coulomb_share", "", 0, 1, 0.0);
  map.finish();
  return temperature;
}

RippleConfig read_ripple(const YamlMap& map) {
  RippleConfig ripple;
  ripple.share = map.quantity("share", "", 0, 0.9);
  ripple.order = map.quantity_or("order", "", 0, 1000, ripple.order);
  ripple.phase_rad = map.quantity_or("phase", "rad", -10, 10, ripple.phase_rad);
  map.finish();
  return ripple;
}

FrictionConfig read_friction(const YamlMap& map) {
  FrictionConfig friction;
  friction.coulomb_Nm = map.quantity("coulomb", "Nm", 0, 1000);
  friction.breakaway_Nm = map.quantity("breakaway", "Nm", friction.coulomb_Nm, 1000);
  friction.stribeck_speed_rad_s = map.quantity("stribeck_speed", "rad/s", 1e-4, 100);
  friction.viscous_Nm_s_rad = map.quantity("viscous", "Nm s/rad", 0, 1000);
  read_load_shares(map, friction);
  friction.asymmetry = map.quantity_or("asymmetry", "", -0.9, 0.9, 0.0);
  if (map.has("temperature")) friction.temperature = read_temperature(map.map("temperature"));
  if (map.has("ripple")) friction.motor_ripple = read_ripple(map.map("ripple"));
  if (map.has("joint_ripple")) friction.joint_ripple = read_ripple(map.map("joint_ripple"));
  friction.presliding_rad = map.quantity_or("presliding", "rad", 0, 0.1, 0.0);
  map.finish();
  return friction;
}

ThermalConfig read_thermal(const YamlMap& map) {
  ThermalConfig thermal;
  thermal.resistance_K_W = map.quantity("resistance", "K/W", 0, 100);
  thermal.time_constant_s = map.quantity("time_constant", "s", 1, 1e5);
  map.finish();
  return thermal;
}

TorsionConfig read_torsion(const YamlMap& map) {
  TorsionConfig torsion;
  torsion.stiffness_Nm_rad = map.quantity("stiffness", "Nm/rad", 100, 1e6);
  torsion.second_stiffness_Nm_rad = map.quantity_or("second_stiffness", "Nm/rad", 100, 1e6,
                                                    torsion.stiffness_Nm_rad);
  torsion.second_from_Nm = map.quantity_or("second_from", "Nm", 0, 1000, 0.0);
  torsion.damping_Nm_s_rad = map.quantity("damping", "Nm s/rad", 0, 1000);
  torsion.backlash_rad = map.quantity_or("backlash", "rad", 0, 0.1, 0.0);
  map.finish();
  return torsion;
}

}  // namespace

PlantJointConfig read_plant_joint(const YamlMap& map) {
  PlantJointConfig joint;
  joint.name = map.text("name");
  const YamlMap stops = map.map("stops");
  joint.stop_min_rad = stops.quantity("min", "rad", -10, 10);
  joint.stop_max_rad = stops.quantity("max", "rad", joint.stop_min_rad, 10);
  stops.finish();
  joint.initial_rad = map.quantity("initial", "rad", joint.stop_min_rad, joint.stop_max_rad);
  if (map.has("lying"))
    joint.lying_rad = map.quantity("lying", "rad", joint.stop_min_rad, joint.stop_max_rad);
  joint.armature_kg_m2 = map.quantity("armature", "kg m^2", 1e-6, 100);
  joint.friction = read_friction(map.map("friction"));
  if (map.has("thermal")) joint.thermal = read_thermal(map.map("thermal"));
  if (map.has("torsion")) joint.torsion = read_torsion(map.map("torsion"));
  map.finish();
  return joint;
}

}  // namespace sprung::sim
