#include "simulation/plant/drive_truth.h"

namespace sprung::sim {

WindingConfig read_winding(const YamlMap& map) {
  WindingConfig winding;
  winding.resistance_ohm = map.quantity("resistance", "ohm", 1e-3, 1000);
  if (map.has("back_emf")) winding.back_emf_V_s_rad = map.quantity("back_emf", "V s/rad", 1e-4, 100);
  winding.voltage_share = map.quantity_or("voltage_share", "", 0.1, 1, winding.voltage_share);
  map.finish();
  return winding;
}

CurrentSensorConfig read_current_sensor(const YamlMap& map) {
  CurrentSensorConfig sensor;
  sensor.offset_A = map.quantity_or("offset", "A", -10, 10, sensor.offset_A);
  sensor.gain = map.quantity_or("gain", "", 0.5, 2, sensor.gain);
  map.finish();
  return sensor;
}

PositionLoopConfig read_position_loop(const YamlMap& map) {
  PositionLoopConfig loop;
  loop.stiffness_share = map.quantity_or("stiffness_share", "", 0.1, 10, loop.stiffness_share);
  loop.damping_share = map.quantity_or("damping_share", "", 0.1, 10, loop.damping_share);
  loop.following_error_rad = map.quantity_or("following_error", "rad", 0, 10, loop.following_error_rad);
  map.finish();
  return loop;
}

SupplyConfig read_supply(const YamlMap& map) {
  SupplyConfig supply;
  supply.voltage_V = map.quantity("voltage", "V", 1, 1000);
  supply.resistance_ohm = map.quantity("resistance", "ohm", 1e-4, 100);
  supply.capacity_F = map.quantity("capacity", "F", 1e-5, 100);
  const std::string source = map.has("source") ? map.text("source") : "battery";
  if (source != "battery" && source != "rectifier")
    map.fail("source", "found '" + source + "', expected battery or rectifier");
  supply.takes_back = source == "battery";
  if (map.has("chopper")) {
    const YamlMap chopper = map.map("chopper");
    supply.chopper_V = chopper.quantity("voltage", "V", supply.voltage_V, 1000);
    supply.chopper_ohm = chopper.quantity("resistance", "ohm", 0.01, 1000);
    chopper.finish();
  }
  map.finish();
  return supply;
}

TimingConfig read_timing(const YamlMap& map) {
  TimingConfig timing;
  timing.compute_s = map.quantity("compute_time", "s", 0, 0.1);
  timing.sync_jitter_s = 1e-6 * map.quantity("sync_jitter", "us", 0, 1000);
  timing.compute_tail_s = map.quantity_or("compute_tail", "s", 0, 0.01, timing.compute_tail_s);
  timing.missed_cycles = map.quantity_or("missed_cycles", "", 0, 0.5, timing.missed_cycles);
  map.finish();
  return timing;
}

}  // namespace sprung::sim
