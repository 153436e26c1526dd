#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/commands/drive/drive_commands.h"
#include "tools/can/node_inspection.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;
using cantools::NodeDescription;

/// One bus that is scanned, and what is told of it.
class BusScan {
 public:
  BusScan(CanBus& bus, int index, const cantools::BusDescription& description, bool as_json, Json& all)
      : bus_(bus), index_(index), description_(description), as_json_(as_json), all_(all) {}

  /// Every node that answers, and those of robot.yaml that do not. @return exit status.
  int run() {
    const std::vector<FoundNode> found = scan_nodes(bus_);
    for (const FoundNode& node : found) tell_found(node);
    for (const NodeDescription& node : description_.nodes) {
      const auto same = [&](const FoundNode& candidate) { return candidate.node == node.node; };
      if (node.bus == index_ && std::none_of(found.begin(), found.end(), same)) tell_missing(node);
    }
    if (found.empty() && !as_json_)
      std::printf(
          "nobody answers: check power, cable, termination, bit rate, and that the interface is up\n");
    return status_;
  }

 private:
  void tell_found(const FoundNode& found);
  void tell_missing(const NodeDescription& node);

  CanBus& bus_;
  const int index_;
  const cantools::BusDescription& description_;
  const bool as_json_;
  Json& all_;
  int status_ = kExitDone;
};

Json found_json(const FoundNode& found, const std::string& bus, const std::string& name,
                const std::vector<ReportLine>& report) {
  Json one{{"bus", bus},
           {"node", found.node},
           {"name", name},
           {"device_type", found.device_type},
           {"duplicate", found.answers > 1}};
  for (const ReportLine& line : report) one[line.name] = line.text;
  return one;
}

std::string text_of(const std::vector<ReportLine>& report, const std::string& name) {
  for (const ReportLine& line : report) {
    if (line.name == name) return line.text;
  }
  return "-";
}

void print_found(const FoundNode& found, const std::string& name, const std::vector<ReportLine>& report) {
  std::printf("%4d  %-18s type 0x%08X  vendor %s product %s revision %s serial %s  %s%s\n", found.node,
              name.c_str(), found.device_type, text_of(report, "vendor").c_str(),
              text_of(report, "product").c_str(), text_of(report, "revision").c_str(),
              text_of(report, "serial number").c_str(), text_of(report, "device name").c_str(),
              found.answers > 1 ? "  TWO DEVICES WITH THIS NODE ID" : "");
}

void BusScan::tell_found(const FoundNode& found) {
  SdoSession session(bus_, found.node);
  const std::vector<ReportLine> report = identify_node(session, nullptr);
  const NodeDescription* known = description_.find(index_, found.node);
  const std::string name = known != nullptr ? known->name : "not in robot.yaml";
  all_.push_back(found_json(found, bus_.describe(), name, report));
  if (found.answers > 1) status_ = kExitFailed;
  if (!as_json_) print_found(found, name, report);
}

void BusScan::tell_missing(const NodeDescription& node) {
  status_ = kExitFailed;
  all_.push_back({{"bus", bus_.describe()}, {"node", node.node}, {"name", node.name}, {"missing", true}});
  if (!as_json_) std::printf("%4d  %-18s in robot.yaml, but does not answer\n", node.node, node.name.c_str());
}

int scan_robot(const DriveRequest& request, Json& all) {
  DriveBench bench(request.where);
  int status = kExitDone;
  for (int i = 0; i < static_cast<int>(bench.robot().buses.size()); ++i) {
    if (!bench.is_chosen(i)) continue;
    CanBus& bus = bench.bus(i);
    const std::string& name = bench.robot().buses[i].name;
    if (!request.as_json) std::printf("%s, %s\n", name.c_str(), bus.describe().c_str());
    if (BusScan(bus, i, bench.description(), request.as_json, all).run() != kExitDone) status = kExitFailed;
  }
  return status;
}

int scan_address(const DriveRequest& request, Json& all) {
  const cantools::BusDescription nobody;
  const auto bus = open_can_bus(request.where.robot);
  return BusScan(*bus, 0, nobody, request.as_json, all).run();
}

int run_scan(const DriveRequest& request) {
  Json all = Json::array();
  const bool address = request.where.robot.find(':') != std::string::npos;
  const int status = address ? scan_address(request, all) : scan_robot(request, all);
  if (request.as_json) std::printf("%s\n", all.dump(1).c_str());
  return status;
}

}  // namespace

void add_drive_scan(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& scan = add_with_robot(
      drive, "scan",
      "Who answers on a bus: all 127 node ids; status 1 when a node of robot.yaml is missing "
      "or an id is taken twice.",
      *request, "robot, or an address: socketcan:can0, udp:GROUP:PORT");
  scan.option("bus", request->where.bus, "which bus of the robot; default: all");
  add_addresses(scan, *request);
  scan.flag("--json", request->as_json, "a JSON array of nodes");
  scan.example("sprung drive scan socketcan:can0");
  scan.action([=] { return run_scan(*request); });
}

}  // namespace sprung::commands
