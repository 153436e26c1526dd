#pragma once
/// What a tool may know of the nodes on a robot's buses, from robot.yaml, the profiles and their EDS. Pure
/// data; making it allocates and may throw.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/canopen/eds.h"
#include "drivers/profiles/drive_profile.h"
#include "robots/robot_config.h"

namespace sprung::cantools {

/// What a channel of an encoder card measures.
struct CardChannel {
  std::string actuator;  ///< name
  LinkEncoderConfig encoder;
};

struct NodeDescription {
  int bus = 0;
  int node = 0;
  std::string name;                         ///< robot.yaml's, e.g. "hip_motor"
  std::shared_ptr<const canopen::Eds> eds;  ///< nullptr where the profile has none
  std::vector<PdoSetting> pdos;             ///< as the bridge configures them
  std::optional<ActuatorConfig> actuator;   ///< of drives: their joint units
  std::optional<EncoderCardConfig> encoder_card;
  std::shared_ptr<const CardProfile> card;  ///< of encoder cards: how to read their sample
  std::vector<CardChannel> card_channels;   ///< those that robot.yaml uses
};

struct BusDescription {
  std::vector<std::string> buses;  ///< names
  std::vector<NodeDescription> nodes;

  /// nullptr where robot.yaml lists no such node.
  const NodeDescription* find(int bus, int node) const noexcept;
  /// "hip_motor", "bridge" for the bridge's own id, else "node 5".
  std::string node_name(int bus, int node) const;
};

/// @throws std::invalid_argument on values that a profile cannot hold, canopen::EdsError on a broken EDS.
BusDescription describe_buses(const RobotConfig& robot);

/// Times that the profile's settings carry, as the bridge has them on a robot or with simulated drives in
/// real time.
DriveTiming drive_timing(const RobotConfig& robot, const WatchdogConfig& watchdogs);

/// The settings and PDOs that robot.yaml's profile wants of this node.
std::unique_ptr<NodeProfile> node_profile(const NodeDescription& node, const DriveTiming& timing);

}  // namespace sprung::cantools
