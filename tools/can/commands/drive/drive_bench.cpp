#include "tools/can/commands/drive/drive_bench.h"

#include <charconv>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "robots/robot_loader.h"
#include "runtime/command_line.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

using cantools::NodeDescription;

namespace {

std::string robot_name(const BusRequest& where) {
  return where.robot.empty() ? require_running(where.instance, "").robot_folder : where.robot;
}

/// 0 where the text is no number of a node.
int node_number(const std::string& text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  const bool valid = error == std::errc() && last == end && number >= 1 && number <= canopen::kMaxNode;
  return valid ? number : 0;
}

}  // namespace

DriveBench::DriveBench(const BusRequest& where)
    : robot_(load_robot(robot_name(where))), where_(where), description_(cantools::describe_buses(robot_)) {
  const std::optional<RunInfo> info = running_as(robot_, where.instance);
  if (info && info->clock == "lockstep" && where.can.empty()) {
    throw std::runtime_error(
        robot_.name +
        " runs in lock-step, which admits no outsiders on its bus: use sprung up --clock realtime");
  }
  const bool simulation = info && info->simulation;
  timing_ = cantools::drive_timing(robot_, simulation ? robot_.simulation_watchdogs : robot_.watchdogs);
  addresses_ = robot_buses(robot_, where);
  buses_.resize(addresses_.size());
}

std::vector<NodeDescription> DriveBench::nodes(const std::string& text) const {
  if (!text.empty()) return {node(text)};
  std::vector<NodeDescription> chosen;
  for (const NodeDescription& node : description_.nodes) {
    if (is_chosen(node.bus)) chosen.push_back(node);
  }
  return chosen;
}

NodeDescription DriveBench::node(const std::string& text) const {
  for (const NodeDescription& node : description_.nodes) {
    if (node.name == text) return node;
  }
  const int number = node_number(text);
  if (number == 0) refuse(text);
  return numbered(number);
}

NodeDescription DriveBench::numbered(int number) const {
  const int bus = bus_of_number(number);
  if (const NodeDescription* known = description_.find(bus, number)) return *known;
  NodeDescription unknown;
  unknown.bus = bus;
  unknown.node = number;
  unknown.name = "node " + std::to_string(number);
  return unknown;
}

int DriveBench::bus_of_number(int number) const {
  if (!where_.bus.empty()) return bus_index(robot_, where_.bus);
  if (robot_.buses.size() > 1) {
    throw WrongUse("node " + std::to_string(number) + ": on which bus? Add --bus, for example --bus " +
                   robot_.buses.front().name);
  }
  return 0;
}

CanBus& DriveBench::bus(int index) {
  auto& bus = buses_[index];
  if (!bus) bus = open_can_bus(addresses_[index].address);
  return *bus;
}

bool DriveBench::is_chosen(int index) const {
  return where_.bus.empty() || index == bus_index(robot_, where_.bus);
}

void DriveBench::refuse(const std::string& text) const {
  std::string known;
  for (const NodeDescription& node : description_.nodes) known += (known.empty() ? "" : ", ") + node.name;
  throw WrongUse("'" + text + "' is no node of " + robot_.name + ": expected one of " + known +
                 ", or a number 1..127");
}

const canopen::EdsObject* described(const NodeDescription& node, canopen::ObjectId object) {
  return node.eds ? node.eds->find(object) : nullptr;
}

std::string object_name(const NodeDescription& node, canopen::ObjectId object) {
  return described(node, object) != nullptr ? node.eds->name_of(object) : canopen::object_name(object.index);
}

canopen::SdoService service_for(const canopen::EdsObject* object) noexcept {
  const bool may_be_long = object != nullptr && canopen::type_bytes(object->type) == 0;
  return may_be_long ? canopen::SdoService::kBlock : canopen::SdoService::kPlain;
}

}  // namespace sprung::commands
