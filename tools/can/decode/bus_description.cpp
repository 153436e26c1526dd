#include "tools/can/decode/bus_description.h"

#include <algorithm>

#include "drivers/profiles/profile_eds.h"

namespace sprung::cantools {
namespace {

std::shared_ptr<const canopen::Eds> eds_of(const std::string& profile, int node) {
  const ProfileKind* kind = find_profile_kind(profile);
  if (kind == nullptr || kind->eds_text == nullptr) return nullptr;
  return std::make_shared<canopen::Eds>(profile_eds(*kind, node));
}

template <class Device>
NodeDescription describe(const Device& device) {
  NodeDescription node;
  node.bus = device.bus;
  node.node = device.node;
  node.name = device.name;
  node.eds = eds_of(device.profile, device.node);
  return node;
}

std::vector<CardChannel> channels_of(const RobotConfig& robot, int card) {
  std::vector<CardChannel> channels;
  for (const ActuatorConfig& actuator : robot.actuators) {
    if (actuator.link_encoder.card == card) channels.push_back({actuator.name, actuator.link_encoder});
  }
  return channels;
}

}  // namespace

const NodeDescription* BusDescription::find(int bus, int node) const noexcept {
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const NodeDescription& candidate) {
    return candidate.bus == bus && candidate.node == node;
  });
  return found == nodes.end() ? nullptr : &*found;
}

std::string BusDescription::node_name(int bus, int node) const {
  const NodeDescription* known = find(bus, node);
  if (known != nullptr) return known->name;
  if (node == canopen::kBridgeNode && !nodes.empty()) return "bridge";
  return "node " + std::to_string(node);
}

DriveTiming drive_timing(const RobotConfig& robot, const WatchdogConfig& watchdogs) {
  return timing_of(robot.cycle_s, watchdogs);
}

std::unique_ptr<NodeProfile> node_profile(const NodeDescription& node, const DriveTiming& timing) {
  if (node.actuator) return make_profile(*node.actuator, timing);
  return make_card_profile(node.encoder_card.value(), timing);
}

BusDescription describe_buses(const RobotConfig& robot) {
  BusDescription description;
  for (const BusConfig& bus : robot.buses) description.buses.push_back(bus.name);
  for (const ActuatorConfig& actuator : robot.actuators) {
    description.nodes.push_back(describe(actuator));
    description.nodes.back().actuator = actuator;
  }
  const DriveTiming timing = drive_timing(robot, robot.watchdogs);
  for (const EncoderCardConfig& card : robot.encoder_cards) {
    const auto index = static_cast<int>(&card - robot.encoder_cards.data());
    NodeDescription& node = description.nodes.emplace_back(describe(card));
    node.encoder_card = card;
    node.card = make_card_profile(card, timing);
    node.card_channels = channels_of(robot, index);
  }
  for (NodeDescription& node : description.nodes) node.pdos = node_profile(node, timing)->pdos();
  return description;
}

}  // namespace sprung::cantools
