#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/canopen/objects.h"
#include "robots/robot_loader.h"
#include "tools/canopen/drive_check.h"
#include "tools/canopen/joint_units.h"
#include "tools/canopen/object_lookup.h"
#include "tools/canopen/object_value.h"
#include "tools/client/bus_choice.h"
#include "tools/client/node_inspection.h"
#include "tools/commands/answers.h"
#include "tools/commands/commands.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;
using cantools::NodeDescription;

struct DriveRequest {
  BusRequest where;
  std::string node;  ///< name or number
  std::vector<std::string> objects;
  std::string object;
  std::string value;
  bool yes = false;
  bool force = false;
  bool as_json = false;
};

/// The robot's description and its buses, opened as they are needed.
class Bench {
 public:
  explicit Bench(const BusRequest& where)
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

  /// All that were asked for: the one named, or every node of the robot (on the bus named).
  std::vector<NodeDescription> nodes(const std::string& text) const {
    if (!text.empty()) return {node(text)};
    std::vector<NodeDescription> chosen;
    for (const NodeDescription& node : description_.nodes) {
      if (where_.bus.empty() || node.bus == bus_index(robot_, where_.bus)) chosen.push_back(node);
    }
    return chosen;
  }

  /// @throws WrongUse naming the nodes there are.
  NodeDescription node(const std::string& text) const {
    for (const NodeDescription& node : description_.nodes) {
      if (node.name == text) return node;
    }
    int number = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || last != text.data() + text.size() || number < 1 || number > canopen::kMaxNode)
      refuse(text);
    if (where_.bus.empty() && robot_.buses.size() > 1)
      throw WrongUse("node " + text + ": on which bus? Add --bus, for example --bus " +
                     robot_.buses.front().name);
    const int bus = where_.bus.empty() ? 0 : bus_index(robot_, where_.bus);
    if (const NodeDescription* known = description_.find(bus, number)) return *known;
    NodeDescription unknown;
    unknown.bus = bus;
    unknown.node = number;
    unknown.name = "node " + text;
    return unknown;
  }

  CanBus& bus(int index) {
    auto& bus = buses_[static_cast<std::size_t>(index)];
    if (!bus) bus = open_can_bus(addresses_[static_cast<std::size_t>(index)].address);
    return *bus;
  }

  const RobotConfig& robot() const { return robot_; }
  const cantools::BusDescription& description() const { return description_; }
  const DriveTiming& timing() const { return timing_; }

 private:
  static std::string robot_name(const BusRequest& where) {
    if (!where.robot.empty()) return where.robot;
    return require_running(where.instance, "").robot_folder;
  }
  [[noreturn]] void refuse(const std::string& text) const {
    std::string known;
    for (const NodeDescription& node : description_.nodes) known += (known.empty() ? "" : ", ") + node.name;
    throw WrongUse("'" + text + "' is no node of " + robot_.name + ": expected one of " + known +
                   ", or a number 1..127");
  }

  RobotConfig robot_;
  BusRequest where_;
  cantools::BusDescription description_;
  DriveTiming timing_;
  std::vector<LiveBus> addresses_;
  std::vector<std::unique_ptr<CanBus>> buses_;
};

Json report_json(const std::vector<ReportLine>& report) {
  Json out;
  for (const ReportLine& line : report) {
    // The history's entries share a name.
    if (line.name.rfind("error history", 0) == 0) {
      if (!out.contains("error history")) out["error history"] = Json::array();
      if (line.text != "empty") out["error history"].push_back(line.text);
    } else {
      out[line.name] = line.text;
    }
  }
  return out;
}

int run_info(const DriveRequest& request) {
  Bench bench(request.where);
  Json all = Json::array();
  int status = kExitDone;
  for (const NodeDescription& node : bench.nodes(request.node)) {
    Json one{{"name", node.name},
             {"bus", bench.robot().buses[static_cast<std::size_t>(node.bus)].name},
             {"node", node.node}};
    try {
      SdoSession session(bench.bus(node.bus), node.node);
      const auto report = inspect_node(session, node, bench.timing());
      one.update(report_json(report));
      if (!request.as_json) {
        std::printf("%s: node %d on %s\n", node.name.c_str(), node.node, session.bus().describe().c_str());
        for (const ReportLine& line : report)
          std::printf("  %-22s %s\n", line.name.c_str(), line.text.c_str());
      }
    } catch (const SdoFailed& error) {
      status = kExitFailed;
      one["error"] = error.what();
      if (!request.as_json) std::fprintf(stderr, "%s: %s\n", node.name.c_str(), error.what());
    }
    all.push_back(one);
  }
  if (request.as_json) std::printf("%s\n", all.dump(1).c_str());
  return status;
}

const canopen::EdsObject* described(const NodeDescription& node, canopen::ObjectId object) {
  return node.eds ? node.eds->find(object) : nullptr;
}

std::string object_name(const NodeDescription& node, canopen::ObjectId object) {
  return described(node, object) != nullptr ? node.eds->name_of(object) : canopen::object_name(object.index);
}

Json value_json(const NodeDescription& node, canopen::ObjectId object, const cantools::ObjectValue& value) {
  Json out{{"node", node.name},
           {"object", canopen::id_text(object)},
           {"name", object_name(node, object)},
           {"value", nullptr},
           {"text", value.text},
           {"unit", value.unit}};
  if (value.number) out["value"] = *value.number;
  return out;
}

std::string joint_text(const NodeDescription& node, canopen::ObjectId object,
                       const cantools::ObjectValue& value) {
  const canopen::EdsObject* known = described(node, object);
  const bool signal = known != nullptr && (known->map_receive || known->map_transmit);
  if (!node.actuator || !value.number || !signal) return "";
  std::string text;
  for (const cantools::JointValue& joint :
       cantools::in_joint_units(*node.actuator, object, value.unit, static_cast<double>(*value.number))) {
    char part[48];
    std::snprintf(part, sizeof part, " = %.6g %s", joint.value, joint.unit);
    text += part;
  }
  return text;
}

int run_read(const DriveRequest& request) {
  Bench bench(request.where);
  const NodeDescription node = bench.node(request.node);
  SdoSession session(bench.bus(node.bus), node.node);
  Json all = Json::array();
  for (const std::string& text : request.objects) {
    const canopen::ObjectId object = cantools::find_object(text, node.eds.get());
    const SdoAnswer answer = session.must_read(object);
    const cantools::ObjectValue value =
        cantools::object_value(described(node, object), object, answer.bytes.data(), answer.bytes.size());
    all.push_back(value_json(node, object, value));
    if (!request.as_json) {
      std::printf("%s %s %s = %s%s\n", node.name.c_str(), canopen::id_text(object).c_str(),
                  object_name(node, object).c_str(), with_unit(value).c_str(),
                  joint_text(node, object, value).c_str());
    }
  }
  if (request.as_json) std::printf("%s\n", all.dump(1).c_str());
  return kExitDone;
}

void refuse_while_driven(CanBus& bus, bool force) {
  if (force || !bridge_drives(bus)) return;
  throw std::runtime_error(
      "a bridge drives " + bus.describe() +
      " (SYNC or its heartbeat was heard): sprung down first, or --force if you know what it does");
}

/// The text of what the object holds now; why not, where it cannot be read.
std::string held(SdoSession& session, const canopen::EdsObject& object) {
  const SdoAnswer answer = session.read(object.id);
  if (!answer.done()) return "not readable";
  return with_unit(cantools::object_value(&object, object.id, answer.bytes.data(), answer.bytes.size()));
}

int run_write(const DriveRequest& request) {
  Bench bench(request.where);
  const NodeDescription node = bench.node(request.node);
  const canopen::ObjectId id = cantools::find_object(request.object, node.eds.get());
  const canopen::EdsObject* object = described(node, id);
  if (object == nullptr)
    throw WrongUse(canopen::id_text(id) + " is not in the EDS of " + node.name +
                   ": its type is not known, so it is not written");
  const std::vector<std::uint8_t> bytes = cantools::bytes_to_write(*object, request.value);
  CanBus& bus = bench.bus(node.bus);
  refuse_while_driven(bus, request.force);
  SdoSession session(bus, node.node);
  (void)session.must_read({canopen::kDeviceType, 0});
  const std::string wanted = with_unit(cantools::object_value(object, id, bytes.data(), bytes.size()));
  const std::string what = node.name + " " + canopen::id_text(id) + " " + object_name(node, id);
  const std::string question = what + ": " + held(session, *object) + " -> " + wanted + ".";
  if (!confirmed(question + " Write?", request.yes)) return kExitFailed;
  session.must_write(id, bytes);
  const bool readable = object->access != canopen::EdsAccess::kWriteOnly;
  const std::string now = readable ? held(session, *object) : wanted;
  if (now != wanted) {
    std::fprintf(stderr, "%s: wrote %s, but it reads back %s\n", what.c_str(), wanted.c_str(), now.c_str());
    return kExitFailed;
  }
  std::printf("%s = %s%s\n", what.c_str(), now.c_str(), readable ? ", read back" : "");
  return kExitDone;
}

std::string text_of(const std::vector<ReportLine>& report, const std::string& name) {
  for (const ReportLine& line : report) {
    if (line.name == name) return line.text;
  }
  return "-";
}

/// One bus: every node that answers, and those of robot.yaml that do not. @return exit status.
int scan_bus(CanBus& bus, int index, const cantools::BusDescription& description, bool as_json, Json& all) {
  int status = kExitDone;
  const std::vector<FoundNode> nodes = scan_nodes(bus);
  for (const FoundNode& found : nodes) {
    SdoSession session(bus, found.node);
    const NodeDescription* known = description.find(index, found.node);
    const auto report = identify_node(session, nullptr);
    const std::string name = known != nullptr ? known->name : "not in robot.yaml";
    Json one{{"bus", bus.describe()},
             {"node", found.node},
             {"name", name},
             {"device_type", found.device_type},
             {"duplicate", found.answers > 1}};
    one.update(report_json(report));
    all.push_back(one);
    if (found.answers > 1) status = kExitFailed;
    if (as_json) continue;
    std::printf("%4d  %-18s type 0x%08X  vendor %s product %s revision %s serial %s  %s%s\n", found.node,
                name.c_str(), found.device_type, text_of(report, "vendor").c_str(),
                text_of(report, "product").c_str(), text_of(report, "revision").c_str(),
                text_of(report, "serial number").c_str(), text_of(report, "device name").c_str(),
                found.answers > 1 ? "  TWO DEVICES WITH THIS NODE ID" : "");
  }
  for (const NodeDescription& node : description.nodes) {
    const auto same = [&](const FoundNode& found) { return found.node == node.node; };
    if (node.bus != index || std::any_of(nodes.begin(), nodes.end(), same)) continue;
    status = kExitFailed;
    all.push_back({{"bus", bus.describe()}, {"node", node.node}, {"name", node.name}, {"missing", true}});
    if (!as_json)
      std::printf("%4d  %-18s in robot.yaml, but does not answer\n", node.node, node.name.c_str());
  }
  if (nodes.empty() && !as_json)
    std::printf("nobody answers: check power, cable, termination, bit rate, and that the interface is up\n");
  return status;
}

int run_scan(const DriveRequest& request) {
  Json all = Json::array();
  int status = kExitDone;
  if (request.where.robot.find(':') != std::string::npos) {
    const auto bus = open_can_bus(request.where.robot);
    status = scan_bus(*bus, 0, {}, request.as_json, all);
  } else {
    Bench bench(request.where);
    for (std::size_t i = 0; i < bench.robot().buses.size(); ++i) {
      const std::string& name = bench.robot().buses[i].name;
      if (!request.where.bus.empty() && bus_index(bench.robot(), request.where.bus) != static_cast<int>(i))
        continue;
      CanBus& bus = bench.bus(static_cast<int>(i));
      if (!request.as_json) std::printf("%s, %s\n", name.c_str(), bus.describe().c_str());
      if (scan_bus(bus, static_cast<int>(i), bench.description(), request.as_json, all) != kExitDone)
        status = kExitFailed;
    }
  }
  if (request.as_json) std::printf("%s\n", all.dump(1).c_str());
  return status;
}

/// One object compared; @return whether it is as it should be.
bool check_object(SdoSession& session, const NodeDescription& node, const cantools::ExpectedObject& expected,
                  bool as_json, Json& rows) {
  const auto value_text = [&](const std::vector<std::uint8_t>& bytes) {
    return with_unit(cantools::object_value(described(node, expected.object), expected.object, bytes.data(),
                                            bytes.size()));
  };
  std::vector<std::uint8_t> wanted;
  for (int i = 0; i < expected.size; ++i)
    wanted.push_back(static_cast<std::uint8_t>(expected.value >> (8 * i)));
  const SdoAnswer answer = session.read(expected.object);
  const bool ok = answer.done() && static_cast<int>(answer.bytes.size()) == expected.size &&
                  cantools::matches(expected, answer.number());
  const std::string found = answer.done() ? value_text(answer.bytes)
                            : answer.status == canopen::SdoStatus::kAborted
                                ? std::string("refused: ") + canopen::abort_text(answer.abort_code)
                                : "no answer";
  const std::string name = object_name(node, expected.object);
  rows.push_back({{"node", node.name},
                  {"object", canopen::id_text(expected.object)},
                  {"name", name},
                  {"expected", value_text(wanted)},
                  {"found", found},
                  {"ok", ok}});
  if (!as_json) {
    std::printf("  %-9s %-52s %-46s %-46s %s\n", canopen::id_text(expected.object).c_str(), name.c_str(),
                value_text(wanted).c_str(), found.c_str(), ok ? "ok" : "DIFFERS");
  }
  return ok;
}

int run_check(const DriveRequest& request) {
  Bench bench(request.where);
  Json rows = Json::array();
  int different = 0, compared = 0;
  for (const NodeDescription& node : bench.nodes(request.node)) {
    if (!node.actuator && !node.encoder_card)
      throw WrongUse(node.name + " is not in robot.yaml: there is nothing to compare it with");
    SdoSession session(bench.bus(node.bus), node.node);
    (void)session.must_read({canopen::kDeviceType, 0});
    if (!request.as_json) {
      std::printf("%s: node %d on %s\n  %-9s %-52s %-46s %-46s\n", node.name.c_str(), node.node,
                  session.bus().describe().c_str(), "object", "name", "expected", "found");
    }
    for (const cantools::ExpectedObject& expected : cantools::expected_objects(node, bench.timing())) {
      ++compared;
      different += check_object(session, node, expected, request.as_json, rows) ? 0 : 1;
    }
  }
  if (request.as_json) {
    std::printf("%s\n", rows.dump(1).c_str());
  } else {
    std::printf(
        "%d objects compared, %d differ%s\n", compared, different,
        different == 0 ? "" : "; the bridge writes its settings when it boots, identities it only verifies");
  }
  return different == 0 ? kExitDone : kExitFailed;
}

using Request = std::shared_ptr<DriveRequest>;

CommandLine& add(CommandLine& drive, const char* name, const char* help, const Request& request,
                 const char* robot_help) {
  CommandLine& command = drive.subcommand(name, help);
  command.option("robot", request->where.robot, robot_help, Need::kRequired);
  return command;
}

void add_common(CommandLine& command, const Request& request) {
  command.option("--bus", request->where.bus, "which bus, where a number names a node or one bus is meant");
  command.option("--can", request->where.can,
                 "ADDRESS or BUS=ADDRESS instead of robot.yaml's: socketcan:can0, udp:GROUP:PORT");
  command.option("--instance", request->where.instance, "which run's addresses, where several robots are up");
}

constexpr const char* kRobot = "name of a folder in robots/, or a folder";
constexpr const char* kNode = "actuator's or encoder card's name, or node id";

void add_info(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& info =
      add(drive, "info", "Identity, NMT state, state word, mode, supply, errors.", request, kRobot);
  info.option("node", request->node, std::string(kNode) + "; default: all");
  info.flag("--json", request->as_json, "a JSON array of nodes");
  add_common(info, request);
  info.example("sprung drive info single_leg knee_motor");
  info.action([=] { return run_info(*request); });
}

void add_read(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& read = add(drive, "read", "Objects of a node, with name and unit.", request, kRobot);
  read.option("node", request->node, kNode, Need::kRequired);
  read.option("object", request->objects, "0x6064, 0x6410:01 or (part of) a name; several may follow",
              Need::kRequired);
  read.flag("--json", request->as_json, "a JSON array of values");
  add_common(read, request);
  read.example("sprung drive read single_leg knee_motor 0x6064 'status word'");
  read.action([=] { return run_read(*request); });
}

void add_write(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& write =
      add(drive, "write", "One object of a node, within the limits of its EDS, and reads it back.", request,
          kRobot);
  write.option("node", request->node, kNode, Need::kRequired);
  write.option("object", request->object, "0x6064, 0x6410:01 or (part of) a name", Need::kRequired);
  write.option("value", request->value, "number in the object's own unit (drive read shows it), or text",
               Need::kRequired);
  write.flag("--yes", request->yes, "do not ask");
  write.flag("--force", request->force, "also while a bridge drives the bus");
  add_common(write, request);
  write.example("sprung drive write single_leg knee_motor 0x6072 1000 --yes");
  write.action([=] { return run_write(*request); });
}

void add_scan(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& scan =
      add(drive, "scan",
          "Who answers on a bus: all 127 node ids; status 1 when a node of robot.yaml is missing "
          "or an id is taken twice.",
          request, "robot, or an address: socketcan:can0, udp:GROUP:PORT");
  scan.option("bus", request->where.bus, "which bus of the robot; default: all");
  scan.option("--can", request->where.can, "ADDRESS or BUS=ADDRESS instead of robot.yaml's");
  scan.option("--instance", request->where.instance, "which run's addresses, where several robots are up");
  scan.flag("--json", request->as_json, "a JSON array of nodes");
  scan.example("sprung drive scan socketcan:can0");
  scan.action([=] { return run_scan(*request); });
}

void add_check(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& check = add(drive, "check",
                           "Compares nodes with what robot.yaml and their profile want, and changes nothing; "
                           "status 1 when they differ.",
                           request, kRobot);
  check.option("node", request->node, std::string(kNode) + "; default: all");
  check.flag("--json", request->as_json, "a JSON array of rows: node, object, name, expected, found, ok");
  add_common(check, request);
  check.example("sprung drive check single_leg");
  check.action([=] { return run_check(*request); });
}

}  // namespace

void add_drive(CommandLine& sprung) {
  CommandLine& drive = sprung.subcommand("drive", "Talk to drives directly over the bus (SDO).");
  drive.example("sprung drive info single_leg");
  add_info(drive);
  add_read(drive);
  add_write(drive);
  add_scan(drive);
  add_check(drive);
}

}  // namespace sprung::commands
