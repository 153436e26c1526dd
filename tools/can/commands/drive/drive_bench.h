#pragma once
/// The robot whose drives are talked to: its description, and its buses, opened as they are needed.
#include <memory>
#include <string>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/canopen/sdo_client.h"
#include "tools/can/bus_choice.h"
#include "tools/can/decode/bus_description.h"
#include "tools/can/decode/object_value.h"

namespace sprung::commands {

class DriveBench {
 public:
  /// @throws std::runtime_error where the robot runs in lock-step: its bus admits no outsiders.
  explicit DriveBench(const BusRequest& where);

  /// All that were asked for: the one named, or every node of the robot (on the bus named).
  std::vector<cantools::NodeDescription> nodes(const std::string& text) const;
  /// By name or number. @throws WrongUse naming the nodes there are.
  cantools::NodeDescription node(const std::string& text) const;

  CanBus& bus(int index);
  /// Whether this bus is meant: the one named, or all.
  bool is_chosen(int index) const;

  const RobotConfig& robot() const { return robot_; }
  const cantools::BusDescription& description() const { return description_; }
  const DriveTiming& timing() const { return timing_; }

 private:
  cantools::NodeDescription numbered(int number) const;
  int bus_of_number(int number) const;
  [[noreturn]] void refuse(const std::string& text) const;

  RobotConfig robot_;
  BusRequest where_;
  cantools::BusDescription description_;
  DriveTiming timing_;
  std::vector<LiveBus> addresses_;
  std::vector<std::unique_ptr<CanBus>> buses_;
};

/// nullptr where no EDS has the object.
const canopen::EdsObject* described(const cantools::NodeDescription& node, canopen::ObjectId object);
std::string object_name(const cantools::NodeDescription& node, canopen::ObjectId object);
/// How to read an object: texts and domains may be long. @param object nullptr where it is not described.
canopen::SdoService service_for(const canopen::EdsObject* object) noexcept;

}  // namespace sprung::commands
