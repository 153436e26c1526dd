#include <algorithm>

#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"

namespace sprung::sim {
namespace {

struct Change {
  const char* key;
  double low;
  double high;
  void (*apply)(SimConfig& config, double value);
};

template <typename Action>
void each_joint(SimConfig& config, Action action) {
  for (PlantJointConfig& joint : config.plant.joints) action(joint);
}

template <typename Action>
void each_drive(SimConfig& config, Action action) {
  for (SimDriveConfig& drive : config.drives) action(drive);
}

void scale_mass(SimConfig& config, double scale) {
  for (PlantBodyConfig& body : config.plant.bodies) body.mass_kg *= scale;
}

void scale_friction(SimConfig& config, double scale) {
  each_joint(config, [scale](PlantJointConfig& joint) {
    joint.friction.coulomb_Nm *= scale;
    joint.friction.breakaway_Nm *= scale;
    joint.friction.viscous_Nm_s_rad *= scale;
    joint.friction.driving_share *= scale;
    joint.friction.back_driving_share *= scale;
  });
}

void scale_coulomb(SimConfig& config, double scale) {
  each_joint(config, [scale](PlantJointConfig& joint) {
    joint.friction.coulomb_Nm *= scale;
    joint.friction.breakaway_Nm *= scale;
  });
}

void scale_load_share(SimConfig& config, double scale) {
  each_joint(config, [scale](PlantJointConfig& joint) {
    joint.friction.driving_share *= scale;
    joint.friction.back_driving_share *= scale;
  });
}

void scale_noise(SimConfig& config, double scale) {
  each_drive(config, [scale](SimDriveConfig& drive) { drive.torque_noise_Nm *= scale; });
  for (SimCardConfig& card : config.cards) card.noise_rad *= scale;
  if (config.torque_sensor) config.torque_sensor->noise_Nm *= scale;
  if (config.imu) {
    for (double ImuConfig::*error :
         {&ImuConfig::rate_noise_rad_s, &ImuConfig::rate_bias_rad_s, &ImuConfig::force_noise_m_s2,
          &ImuConfig::force_bias_m_s2, &ImuConfig::attitude_noise_rad, &ImuConfig::tilt_bias_rad,
          &ImuConfig::yaw_drift_rad_s}) {
      (*config.imu).*error *= scale;
    }
  }
}

void switch_imu(SimConfig& config, double on) {
  if (on != 0.0 && !config.imu) throw ConfigError("--plant imu: this robot's sim.yaml has none");
  if (on == 0.0) config.imu.reset();
}

void switch_torsion(SimConfig& config, double on) {
  const bool any = std::any_of(config.plant.joints.begin(), config.plant.joints.end(),
                               [](const PlantJointConfig& joint) { return joint.torsion.has_value(); });
  if (on != 0.0 && !any) throw ConfigError("--plant torsion: no joint of this robot's sim.yaml has torsion");
  config.plant.torsion = on != 0.0;
}

void switch_windings(SimConfig& config, double on) {
  const bool any = std::any_of(config.drives.begin(), config.drives.end(),
                               [](const SimDriveConfig& drive) { return drive.winding.has_value(); });
  if (on != 0.0 && !any)
    throw ConfigError("--plant winding: no drive of this robot's sim.yaml has a winding");
  config.real_windings = on != 0.0;
}

SupplyConfig& supply(SimConfig& config, const char* key) {
  if (!config.supply)
    throw ConfigError(std::string("--plant ") + key + ": this robot's sim.yaml has no supply");
  return *config.supply;
}

/// sim.yaml's first, or one of no height.
GroundStep& step(SimConfig& config) {
  if (config.plant.ground.steps.empty()) config.plant.ground.steps.emplace_back();
  return config.plant.ground.steps.front();
}

/// Whether the robot starts on the floor: as --plant lying says; else not where --plant suspended says how it
/// hangs or stands; else as sim.yaml says.
bool lies(const std::map<std::string, double>& changes, const PlantConfig& plant) {
  const auto lying = changes.find("lying");
  if (lying != changes.end()) return lying->second != 0.0;
  return plant.lies && changes.count("suspended") == 0;
}

void lie_down(SimConfig& config) {
  each_joint(config, [](PlantJointConfig& joint) {
    if (!joint.lying_rad) throw ConfigError("lying: sim.yaml's " + joint.name + " has no `lying`");
    joint.initial_rad = *joint.lying_rad;
  });
}

void scale_armature(SimConfig& config, double scale) {
  each_joint(config, [scale](PlantJointConfig& joint) { joint.armature_kg_m2 *= scale; });
}

/// What `--plant` may change, in SI units (times in us where the key says so), sorted by key.
constexpr Change kChanges[] = {
    {"armature_scale", 0.01, 100, scale_armature},
    {"compute_tail_us", 0, 1e4, [](SimConfig& c, double v) { c.timing.compute_tail_s = 1e-6 * v; }},
    {"compute_time_us", 0, 1e5, [](SimConfig& c, double v) { c.timing.compute_s = 1e-6 * v; }},
    {"coulomb_scale", 0, 100, scale_coulomb},
    {"current_gain", 0.5, 2,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& d) { d.current_sensor.gain = v; }); }},
    {"current_offset", -10, 10,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& d) { d.current_sensor.offset_A = v; });
     }},
    {"factory_node", 0, 255,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& drive) { drive.factory_node = static_cast<int>(v); });
     }},
    {"floor_height", -10, 10, [](SimConfig& c, double v) { c.plant.floor_height_m = v; }},
    {"foot_radius_scale", 0.1, 10, [](SimConfig& c, double v) { c.plant.foot_radius_factor *= v; }},
    {"foot_weight", 0, 50, [](SimConfig& c, double v) { c.plant.foot_weight_kg = v; }},
    {"friction_scale", 0, 100, scale_friction},
    {"ground_begins", -1000, 1000, [](SimConfig& c, double v) { c.plant.ground.begins_m = v; }},
    {"ground_damping", 0, 1e6, [](SimConfig& c, double v) { c.plant.contact.damping_N_s_m = v; }},
    {"ground_error", 0, 1, [](SimConfig& c, double v) { c.plant.ground.error_m = v; }},
    {"ground_friction", 0, 10, [](SimConfig& c, double v) { c.plant.contact.friction = v; }},
    {"ground_scale", 0, 10, [](SimConfig& c, double v) { c.plant.ground.scale_heights(v); }},
    {"ground_seed", 0, 1e9,
     [](SimConfig& c, double v) { c.plant.ground.error_seed = static_cast<std::uint64_t>(v); }},
    {"ground_stiffness", 1, 1e7, [](SimConfig& c, double v) { c.plant.contact.stiffness_N_m = v; }},
    {"heating_scale", 0, 100,
     [](SimConfig& c, double v) {
       each_joint(c, [v](PlantJointConfig& joint) { joint.thermal.resistance_K_W *= v; });
     }},
    {"imu", 0, 1, switch_imu},
    {"kinematic_error_scale", 0, 100,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& drive) { drive.kinematic_error.amplitude_rad *= v; });
     }},
    {"kt_scale", 0.1, 10,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& drive) { drive.torque_constant_Nm_A *= v; });
     }},
    {"load_share_scale", 0, 5, scale_load_share},
    {"lying", 0, 1,
     [](SimConfig& c, double v) {
       if (v != 0.0) c.plant.suspended_m = 0.0;
     }},
    {"mass_scale", 0.1, 10, scale_mass},
    {"missed_cycles", 0, 0.5, [](SimConfig& c, double v) { c.timing.missed_cycles = v; }},
    {"mode_delay_us", 0, 1e6,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& d) { d.mode_delay_s = 1e-6 * v; }); }},
    {"noise_scale", 0, 100, scale_noise},
    {"patch_friction", 0, 10,
     [](SimConfig& c, double v) {
       for (GroundPatch& patch : c.plant.ground.patches) patch.friction = v;
     }},
    {"payload", 0, 100, [](SimConfig& c, double v) { c.plant.payload.mass_kg = v; }},
    {"payload_x", -2, 2, [](SimConfig& c, double v) { c.plant.payload.place_m[0] = v; }},
    {"payload_y", -2, 2, [](SimConfig& c, double v) { c.plant.payload.place_m[1] = v; }},
    {"payload_z", -2, 2, [](SimConfig& c, double v) { c.plant.payload.place_m[2] = v; }},
    {"peak_torque", 0.001, 1e4,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& drive) { drive.peak_torque_Nm = v; }); }},
    {"position_damping_share", 0.1, 10,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& d) { d.position_loop.damping_share = v; });
     }},
    {"position_smoothing_us", 0, 1e6,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& d) { d.smoothing_s = 1e-6 * v; }); }},
    {"position_stiffness_share", 0.1, 10,
     [](SimConfig& c, double v) {
       each_drive(c, [v](SimDriveConfig& d) { d.position_loop.stiffness_share = v; });
     }},
    {"rail_x_locked", 0, 1, [](SimConfig& c, double v) { c.plant.rail_x_locked = v != 0.0; }},
    {"roll", -3.15, 3.15, [](SimConfig& c, double v) { c.plant.roll_rad = v; }},
    {"side_slope", -1, 1, [](SimConfig& c, double v) { c.plant.ground.side_slope_rad = v; }},
    {"slope", -1, 1, [](SimConfig& c, double v) { c.plant.ground.slope_rad = v; }},
    {"starts_in_fault", 0, 1,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& d) { d.starts_in_fault = v != 0.0; }); }},
    {"step_from", -1000, 1000, [](SimConfig& c, double v) { step(c).area.from_m = v; }},
    {"step_height", -1, 1, [](SimConfig& c, double v) { step(c).height_m = v; }},
    {"step_length", 0, 1000, [](SimConfig& c, double v) { step(c).area.length_m = v; }},
    {"step_right", -1000, 1000, [](SimConfig& c, double v) { step(c).area.right_m = v; }},
    {"step_width", 0, 1000, [](SimConfig& c, double v) { step(c).area.width_m = v; }},
    {"step_us", 50, 1000, [](SimConfig& c, double v) { c.plant.step_s = 1e-6 * v; }},
    {"supply_resistance", 1e-4, 100,
     [](SimConfig& c, double v) { supply(c, "supply_resistance").resistance_ohm = v; }},
    {"supply_voltage", 1, 1000, [](SimConfig& c, double v) { supply(c, "supply_voltage").voltage_V = v; }},
    {"suspended", 0, 10, [](SimConfig& c, double v) { c.plant.suspended_m = v; }},
    {"sync_jitter_us", 0, 1000, [](SimConfig& c, double v) { c.timing.sync_jitter_s = 1e-6 * v; }},
    {"temperature", -50, 150, [](SimConfig& c, double v) { c.plant.ambient_degC = v; }},
    {"torque_loop_Hz", 1, 1e4,
     [](SimConfig& c, double v) { each_drive(c, [v](SimDriveConfig& drive) { drive.torque_loop_Hz = v; }); }},
    {"torsion", 0, 1, switch_torsion},
    {"viscous_scale", 0, 100,
     [](SimConfig& c, double v) {
       each_joint(c, [v](PlantJointConfig& joint) { joint.friction.viscous_Nm_s_rad *= v; });
     }},
    {"wave", 0, 1, [](SimConfig& c, double v) { c.plant.ground.wave_m = v; }},
    {"wave_length", 0.05, 1000, [](SimConfig& c, double v) { c.plant.ground.wave_length_m = v; }},
    {"winding", 0, 1, switch_windings},
};

const Change& find_change(const std::string& key) {
  std::string known = "draw, family=NAME, world=NAME";
  for (const Change& change : kChanges) {
    if (key == change.key) return change;
    known += std::string(", ") + change.key;
  }
  throw ConfigError("--plant " + key + ": unknown key; there are " + known);
}

}  // namespace

void apply_plant_changes(const std::map<std::string, double>& changes, SimConfig& config) {
  for (const auto& [key, value] : changes) {
    const Change& change = find_change(key);
    if (!(value >= change.low && value <= change.high)) {
      throw ConfigError("--plant " + key + ": found " + std::to_string(value) + ", expected " +
                        std::to_string(change.low) + " to " + std::to_string(change.high));
    }
    change.apply(config, value);
  }
  config.plant.lies = lies(changes, config.plant);
  if (config.plant.lies) lie_down(config);
}

}  // namespace sprung::sim
