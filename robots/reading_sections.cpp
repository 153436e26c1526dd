#include "robots/reading_sections.h"

#include "robots/robot_sections.h"

namespace sprung::robot_sections {
namespace {

// CiA 418, battery module [unverified: from memory of the profile; type what your battery has].
constexpr ReadingConfig kVoltage418{0x6060, 0, 4, false, 1.0 / 1024.0};
constexpr ReadingConfig kCharge418{0x6081, 0, 1, false, 0.01};
constexpr ReadingConfig kTemperature418{0x6010, 0, 2, true, 0.125};

/// Index, type and scale; the caller may ask the map for more, and finishes it.
ReadingConfig read_reading(const YamlMap& map, const char* unit) {
  static const std::vector<std::string> kTypes = {"u8", "i8", "u16", "i16", "u32", "i32"};
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4};
  ReadingConfig reading;
  reading.index = static_cast<std::uint16_t>(map.integer("object", 0x1000, 0xFFFF));
  reading.sub = static_cast<std::uint8_t>(map.integer_or("sub", 0, 254, 0));
  const int type = choice(map, "type", kTypes);
  reading.bytes = kBytes[type];
  reading.is_signed = type % 2 == 1;
  reading.scale = map.quantity("scale", unit, 1e-9, 1e6);
  return reading;
}

ReadingConfig read_whole(const YamlMap& map, const char* key, const char* unit,
                         const ReadingConfig& standard) {
  if (!map.has(key)) return standard;
  const YamlMap section = map.map(key);
  const ReadingConfig reading = read_reading(section, unit);
  section.finish();
  return reading;
}

}  // namespace

TemperatureConfig read_temperature(const YamlMap& map) {
  TemperatureConfig temperature;
  temperature.reading = read_reading(map, "degC");
  temperature.max_degC = map.quantity("max", "degC", 20, 250);
  map.finish();
  return temperature;
}

BatteryConfig read_battery(const YamlMap& map, const std::vector<BusConfig>& buses) {
  BatteryConfig battery;
  battery.bus = index_of(buses, map.text("bus"), map, "bus");
  battery.node = static_cast<int>(map.integer("node", 1, 126));
  battery.voltage = read_whole(map, "voltage", "V", kVoltage418);
  battery.charge = read_whole(map, "charge", "", kCharge418);
  battery.temperature = read_whole(map, "temperature", "degC", kTemperature418);
  battery.min_charge_share = map.quantity_or("min_charge", "", 0, 1, 0.0);
  map.finish();
  return battery;
}

}  // namespace sprung::robot_sections
