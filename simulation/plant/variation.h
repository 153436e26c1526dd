#pragma once
/// robots/<name>/variation.yaml: how far another robot of the same make, on another day, may differ from
/// sim.yaml. Start-up only; the stack never reads it.
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "simulation/plant/sim_config.h"

namespace sprung::sim {

/// Something that differs from robot to robot; it has a row in the table of variation.cpp.
struct VariedQuantity {
  enum class Section {
    kPlant,     ///< one value for all
    kBody,      ///< one for each of sim.yaml's bodies, as the next for joints and drives
    kJoint,     ///< whatever the friction is
    kFriction,  ///< of a joint: sim.yaml's class, where no family is asked for
    kFamily,    ///< of a joint: in place of sim.yaml's
    kDrive,
    kImu,  ///< one value, where there is an IMU
  };
  Section section;
  const char* key;
  const char* unit;
  double low, high;                                                  ///< what a file may say
  void (*apply)(SimConfig& config, std::size_t item, double value);  ///< may throw ConfigError
};

/// Any value from `from` to `to` is as likely as any other.
struct VariedSpan {
  const VariedQuantity* quantity = nullptr;
  double from = 0.0;
  double to = 0.0;
};

struct Variation {
  bool elastic_gears = false;     ///< drawn plants' gears twist where sim.yaml gives them torsion
  bool real_windings = false;     ///< voltage and back-EMF limit their currents where sim.yaml gives windings
  std::vector<VariedSpan> spans;  ///< in the table's order; of no family
  std::map<std::string, std::vector<VariedSpan>> families;
};

/// @throws ConfigError also on an unknown section or quantity.
Variation read_variation(const YamlMap& file, const RobotConfig& robot);
/// @throws ConfigError also where robot.folder has none.
Variation load_variation(const RobotConfig& robot);

}  // namespace sprung::sim
