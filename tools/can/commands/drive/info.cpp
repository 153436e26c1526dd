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

void print_report(const NodeDescription& node, const std::string& bus,
                  const std::vector<ReportLine>& report) {
  std::printf("%s: node %d on %s\n", node.name.c_str(), node.node, bus.c_str());
  for (const ReportLine& line : report) std::printf("  %-22s %s\n", line.name.c_str(), line.text.c_str());
}

/// @throws SdoFailed where the node does not answer.
Json inspect(DriveBench& bench, const NodeDescription& node, bool as_json) {
  SdoSession session(bench.bus(node.bus), node.node);
  const std::vector<ReportLine> report = inspect_node(session, node, bench.timing());
  if (!as_json) print_report(node, session.bus().describe(), report);
  return report_json(report);
}

int run_info(const DriveRequest& request) {
  DriveBench bench(request.where);
  Json all = Json::array();
  int status = kExitDone;
  for (const NodeDescription& node : bench.nodes(request.node)) {
    const std::string& bus = bench.robot().buses[node.bus].name;
    Json one{{"name", node.name}, {"bus", bus}, {"node", node.node}};
    try {
      one.update(inspect(bench, node, request.as_json));
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

}  // namespace

void add_drive_info(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& info = add_with_robot(drive, "info", "Identity, NMT state, state word, mode, supply, errors.",
                                     *request);
  info.option("node", request->node, std::string(kNodeHelp) + "; default: all");
  info.flag("--json", request->as_json, "a JSON array of nodes");
  add_bus_choice(info, *request);
  info.example("sprung drive info single_leg knee_motor");
  info.action([=] { return run_info(*request); });
}

}  // namespace sprung::commands
