#pragma once
/// Parts of sim.yaml about what turns the joints: windings, current sensors, position loops, the supply that
/// all drives share, and the computer that sends the set-points. Start-up only.
#include <optional>

#include "robots/yaml_reader.h"

namespace sprung::sim {

/// Of a motor, between two terminals, as its data sheet has it.
struct WindingConfig {
  double resistance_ohm = 0.0;
  std::optional<double> back_emf_V_s_rad;  ///< of the motor's shaft; nothing: the torque constant
  double voltage_share = 1.0;              ///< of the supply that the power stage lets through
};

/// What the drive's current sensor shows of a true current: gain times it and offset; noise comes on top. The
/// current loop brings what is shown to the set-point, so the true current differs.
struct CurrentSensorConfig {
  double offset_A = 0.0;
  double gain = 1.0;
};

/// What the drive's position loop truly has of what robot.yaml or the drive's objects say.
struct PositionLoopConfig {
  double stiffness_share = 1.0;
  double damping_share = 1.0;
  double following_error_rad = 0.0;  ///< 0x8611 beyond it, gear output side; 0: as the make's objects say
};

/// Source behind a resistance, a capacitor at the drives, and perhaps a brake chopper there.
struct SupplyConfig {
  double voltage_V = 0.0;  ///< without load
  double resistance_ohm = 0.0;
  double capacity_F = 0.0;
  bool takes_back = true;    ///< a battery does; behind a rectifier braking charges the capacitor alone
  double chopper_V = 0.0;    ///< 0: there is none
  double chopper_ohm = 1.0;  ///< of its resistor
};

struct TimingConfig {
  double compute_s = 0.0;       ///< from the last answer to the first set-point on the bus
  double sync_jitter_s = 0.0;   ///< rms of the instant at which an encoder is read
  double compute_tail_s = 0.0;  ///< mean of what comes on top of compute_s, with a long tail (computer.h)
  double missed_cycles = 0.0;   ///< share of the cycles in which no set-point is sent
};

/// @throws ConfigError, each of them.
WindingConfig read_winding(const YamlMap& map);
CurrentSensorConfig read_current_sensor(const YamlMap& map);
PositionLoopConfig read_position_loop(const YamlMap& map);
SupplyConfig read_supply(const YamlMap& map);
TimingConfig read_timing(const YamlMap& map);

}  // namespace sprung::sim
