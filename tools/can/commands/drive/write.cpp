#include <cstdio>
#include <memory>

#include "drivers/canopen/objects.h"
#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/commands/drive/drive_commands.h"
#include "tools/can/decode/object_lookup.h"
#include "tools/can/node_inspection.h"
#include "tools/can/sdo_session.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {

namespace {

using cantools::NodeDescription;

/// The text of what the object holds now; why not, where it cannot be read.
std::string held(SdoSession& session, const canopen::EdsObject& object) {
  const SdoAnswer answer = session.read(object.id, service_for(&object));
  if (!answer.done()) return "not readable";
  return with_unit(cantools::object_value(&object, object.id, answer.bytes.data(), answer.bytes.size()));
}

const canopen::EdsObject& writable(const NodeDescription& node, const std::string& text) {
  const canopen::ObjectId id = cantools::find_object(text, node.eds.get());
  const canopen::EdsObject* object = described(node, id);
  if (object == nullptr) {
    throw WrongUse(canopen::id_text(id) + " is not in the EDS of " + node.name +
                   ": its type is not known, so it is not written");
  }
  return *object;
}

/// Writes when the operator agrees, and compares with what is read back. @return exit status.
int write_object(SdoSession& session, const NodeDescription& node, const canopen::EdsObject& object,
                 const std::vector<std::uint8_t>& bytes, bool yes) {
  const std::string wanted = with_unit(
      cantools::object_value(&object, object.id, bytes.data(), bytes.size()));
  const std::string what = node.name + " " + canopen::id_text(object.id) + " " + object_name(node, object.id);
  const std::string question = what + ": " + held(session, object) + " -> " + wanted + ".";
  if (!confirmed(question + " Write?", yes)) return kExitFailed;
  session.must_write(object.id, bytes);
  const bool readable = object.access != canopen::EdsAccess::kWriteOnly;
  const std::string now = readable ? held(session, object) : wanted;
  if (now != wanted) {
    std::fprintf(stderr, "%s: wrote %s, but it reads back %s\n", what.c_str(), wanted.c_str(), now.c_str());
    return kExitFailed;
  }
  std::printf("%s = %s%s\n", what.c_str(), now.c_str(), readable ? ", read back" : "");
  return kExitDone;
}

int run_write(const DriveRequest& request) {
  DriveBench bench(request.where);
  const NodeDescription node = bench.node(request.node);
  const canopen::EdsObject& object = writable(node, request.object);
  const std::vector<std::uint8_t> bytes = cantools::bytes_to_write(object, request.value);
  CanBus& bus = bench.bus(node.bus);
  refuse_while_driven(bus, request.force);
  SdoSession session(bus, node.node);
  (void)session.must_read({canopen::kDeviceType, 0});  // says at once when nobody is there
  return write_object(session, node, object, bytes, request.yes);
}

}  // namespace

void add_drive_write(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& write = add_with_robot(
      drive, "write", "One object of a node, within the limits of its EDS, and reads it back.", *request);
  write.option("node", request->node, kNodeHelp, Need::kRequired);
  write.option("object", request->object, "0x6064, 0x6410:01 or (part of) a name", Need::kRequired);
  write.option("value", request->value, "number in the object's own unit (drive read shows it), or text",
               Need::kRequired);
  write.flag("--yes", request->yes, "do not ask");
  write.flag("--force", request->force, "also while a bridge drives the bus");
  add_bus_choice(write, *request);
  write.example("sprung drive write single_leg knee_motor 0x6072 1000 --yes");
  write.action([=] { return run_write(*request); });
}

}  // namespace sprung::commands
