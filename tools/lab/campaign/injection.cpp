#include "tools/lab/campaign/injection.h"

#include <cstdio>
#include <utility>

namespace sprung::campaign {
namespace {

constexpr const char* kProcessNames[] = {"bridge", "estimator", "planner", "controller"};

std::string what(const Injection& injection, const RobotConfig& robot) {
  const auto& actuators = robot.actuators;
  const std::string actuator = actuators[injection.target % static_cast<int>(actuators.size())].name;
  switch (injection.kind) {
    case Class::kNone:
      return "nothing";
    case Class::kDrive:
      return std::string(name(injection.drive_fault)) + " of " + actuator;
    case Class::kBus:
      return std::string(name(injection.drive_fault)) + " of " +
             (injection.half_of_buses ? "half of the buses" : "bus " + robot.buses[injection.target].name);
    case Class::kMessage:
      return std::string(name(injection.link)) + " " + name(injection.link_fault);
    case Class::kField:
      return std::string(name(injection.link)) + " field " + std::to_string(injection.field) + " of part " +
             std::to_string(injection.target) + " " + name(injection.field_fault);
    case Class::kProcess:
      return std::string(kProcessNames[static_cast<int>(injection.process)]) + " " +
             name(injection.process_fault);
    case Class::kForeign:
      return std::string("foreign ") + name(injection.foreign) + " to " + actuator;
    case Class::kFile:
      return std::string("wrong ") + name(injection.mistake) + " of " + actuator + " in robot.yaml";
  }
  return "";
}

}  // namespace

std::string text_of(const Injection& injection, const RobotConfig& robot) {
  std::string text = what(injection, robot);
  char number[64];
  if (injection.value != 0.0) {
    std::snprintf(number, sizeof number, " (%.3g)", injection.value);
    text += number;
  }
  if (injection.duration_s > 0.0) {
    std::snprintf(number, sizeof number, " for %.3f s", injection.duration_s);
    text += number;
  }
  return text;
}

RobotConfig with_mistake(RobotConfig robot, const Injection& injection) {
  if (injection.kind != Class::kFile) return robot;
  const int count = static_cast<int>(robot.actuators.size());
  ActuatorConfig& actuator = robot.actuators[injection.target % count];
  switch (injection.mistake) {
    case FileMistake::kSign:
      actuator.direction = -actuator.direction;
      break;
    case FileMistake::kSwapped:
      for (ActuatorConfig& other : robot.actuators) {
        if (&other == &actuator || other.bus != actuator.bus) continue;
        std::swap(other.node, actuator.node);
        break;
      }
      break;
    case FileMistake::kZero:
      actuator.offset_rad += injection.value;
      actuator.link_encoder.offset_rad += injection.value;
      break;
    case FileMistake::kRatio:
      actuator.torque_constant_Nm_A *= injection.value;
      break;
  }
  return robot;
}

}  // namespace sprung::campaign
