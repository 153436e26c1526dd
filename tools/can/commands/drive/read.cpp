#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/canopen/objects.h"
#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/commands/drive/drive_commands.h"
#include "tools/can/decode/frame_line.h"
#include "tools/can/decode/joint_units.h"
#include "tools/can/decode/object_lookup.h"
#include "tools/can/sdo_session.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;
using cantools::NodeDescription;

Json value_json(const NodeDescription& node, canopen::ObjectId object, const cantools::ObjectValue& value) {
  return {{"node", node.name},
          {"object", canopen::id_text(object)},
          {"name", object_name(node, object)},
          {"value", cantools::number_json(value)},
          {"text", value.text},
          {"unit", value.unit}};
}

std::string joint_text(const NodeDescription& node, canopen::ObjectId object,
                       const cantools::ObjectValue& value) {
  const canopen::EdsObject* known = described(node, object);
  const bool signal = known != nullptr && (known->map_receive || known->map_transmit);
  if (!node.actuator || !value.number || !signal) return "";
  std::string text;
  for (const cantools::JointValue& joint :
       cantools::in_joint_units(*node.actuator, object, value.unit, cantools::as_double(value))) {
    char part[48];
    std::snprintf(part, sizeof part, " = %.6g %s", joint.value, joint.unit);
    text += part;
  }
  return text;
}

void print_value(const NodeDescription& node, canopen::ObjectId object, const cantools::ObjectValue& value) {
  std::printf("%s %s %s = %s%s\n", node.name.c_str(), canopen::id_text(object).c_str(),
              object_name(node, object).c_str(), with_unit(value).c_str(),
              joint_text(node, object, value).c_str());
}

int run_read(const DriveRequest& request) {
  DriveBench bench(request.where);
  const NodeDescription node = bench.node(request.node);
  SdoSession session(bench.bus(node.bus), node.node);
  Json all = Json::array();
  for (const std::string& text : request.objects) {
    const canopen::ObjectId object = cantools::find_object(text, node.eds.get());
    const SdoAnswer answer = session.must_read(object, service_for(described(node, object)));
    const cantools::ObjectValue value = cantools::object_value(described(node, object), object,
                                                               answer.bytes.data(), answer.bytes.size());
    all.push_back(value_json(node, object, value));
    if (!request.as_json) print_value(node, object, value);
  }
  if (request.as_json) std::printf("%s\n", all.dump(1).c_str());
  return kExitDone;
}

}  // namespace

void add_drive_read(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& read = add_with_robot(drive, "read", "Objects of a node, with name and unit.", *request);
  read.option("node", request->node, kNodeHelp, Need::kRequired);
  read.option("object", request->objects, "0x6064, 0x6410:01 or (part of) a name; several may follow",
              Need::kRequired);
  read.flag("--json", request->as_json, "a JSON array of values");
  add_bus_choice(read, *request);
  read.example("sprung drive read single_leg knee_motor 0x6064 'status word'");
  read.action([=] { return run_read(*request); });
}

}  // namespace sprung::commands
