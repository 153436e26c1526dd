#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/canopen/objects.h"
#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/commands/drive/drive_commands.h"
#include "tools/can/decode/drive_check.h"
#include "tools/can/sdo_session.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;
using cantools::NodeDescription;

/// One object as robot.yaml and the profile want it, and as it was found.
struct Row {
  canopen::ObjectId object;
  std::string name;
  std::string expected;
  std::string found;
  bool ok = false;
};

std::vector<std::uint8_t> bytes_of(const cantools::ExpectedObject& expected) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(expected.size);
  for (int i = 0; i < expected.size; ++i)
    bytes.push_back(static_cast<std::uint8_t>(expected.value >> (8 * i)));
  return bytes;
}

std::string found_text(const SdoAnswer& answer, const NodeDescription& node, canopen::ObjectId object) {
  if (answer.done()) {
    return with_unit(
        cantools::object_value(described(node, object), object, answer.bytes.data(), answer.bytes.size()));
  }
  if (answer.status != canopen::SdoStatus::kAborted) return "no answer";
  return std::string("refused: ") + canopen::abort_text(answer.abort_code);
}

Row compare(SdoSession& session, const NodeDescription& node, const cantools::ExpectedObject& expected) {
  const canopen::ObjectId object = expected.object;
  const std::vector<std::uint8_t> wanted = bytes_of(expected);
  const SdoAnswer answer = session.read(object);
  const bool same_size = static_cast<int>(answer.bytes.size()) == expected.size;
  return {object, object_name(node, object),
          with_unit(cantools::object_value(described(node, object), object, wanted.data(), wanted.size())),
          found_text(answer, node, object),
          answer.done() && same_size && cantools::matches(expected, answer.number())};
}

void print_row(const Row& row) {
  std::printf("  %-9s %-52s %-46s %-46s %s\n", canopen::id_text(row.object).c_str(), row.name.c_str(),
              row.expected.c_str(), row.found.c_str(), row.ok ? "ok" : "DIFFERS");
}

Json row_json(const NodeDescription& node, const Row& row) {
  return {{"node", node.name},  {"object", canopen::id_text(row.object)},
          {"name", row.name},   {"expected", row.expected},
          {"found", row.found}, {"ok", row.ok}};
}

void print_heading(const NodeDescription& node, const std::string& bus) {
  std::printf("%s: node %d on %s\n  %-9s %-52s %-46s %-46s\n", node.name.c_str(), node.node, bus.c_str(),
              "object", "name", "expected", "found");
}

struct Counts {
  int compared = 0;
  int different = 0;
};

void check_node(DriveBench& bench, const NodeDescription& node, bool as_json, Json& rows, Counts& counts) {
  if (!node.actuator && !node.encoder_card)
    throw WrongUse(node.name + " is not in robot.yaml: there is nothing to compare it with");
  SdoSession session(bench.bus(node.bus), node.node);
  (void)session.must_read({canopen::kDeviceType, 0});  // says at once when nobody is there
  if (!as_json) print_heading(node, session.bus().describe());
  for (const cantools::ExpectedObject& expected : cantools::expected_objects(node, bench.timing())) {
    const Row row = compare(session, node, expected);
    rows.push_back(row_json(node, row));
    if (!as_json) print_row(row);
    ++counts.compared;
    counts.different += row.ok ? 0 : 1;
  }
}

void print_counts(const Counts& counts) {
  std::printf("%d objects compared, %d differ%s\n", counts.compared, counts.different,
              counts.different == 0
                  ? ""
                  : "; the bridge writes its settings when it boots, identities it only verifies");
}

int run_check(const DriveRequest& request) {
  DriveBench bench(request.where);
  Json rows = Json::array();
  Counts counts;
  for (const NodeDescription& node : bench.nodes(request.node))
    check_node(bench, node, request.as_json, rows, counts);
  if (request.as_json) {
    std::printf("%s\n", rows.dump(1).c_str());
  } else {
    print_counts(counts);
  }
  return counts.different == 0 ? kExitDone : kExitFailed;
}

}  // namespace

void add_drive_check(CommandLine& drive) {
  const auto request = std::make_shared<DriveRequest>();
  CommandLine& check = add_with_robot(
      drive, "check",
      "Compares nodes with what robot.yaml and their profile want, and changes nothing; "
      "status 1 when they differ.",
      *request);
  check.option("node", request->node, std::string(kNodeHelp) + "; default: all");
  check.flag("--json", request->as_json, "a JSON array of rows: node, object, name, expected, found, ok");
  add_bus_choice(check, *request);
  check.example("sprung drive check single_leg");
  check.action([=] { return run_check(*request); });
}

}  // namespace sprung::commands
