/// sprung param: numbers of robot.yaml that change while the robot runs.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "robots/overlay.h"
#include "signals/number_text.h"
#include "tools/commands.h"
#include "tools/common/report/report_shell.h"
#include "tools/operate/client/parameter_client.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ParameterCall {
  std::string instance = "default", robot, name, value, out;
  bool json = false;
};

ParameterClient client_of(const ParameterCall& call) {
  return ParameterClient(require_running(call.instance, call.robot));
}

std::size_t place_named(const ParameterClient& client, const std::string& name) {
  try {
    return parameter_named(client.parameters(), name);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

Json parameter_json(const Parameter& one, double value) {
  return {{"name", one.name},
          {"value", value},
          {"unit", one.unit},
          {"file", one.file},
          {"least", one.least},
          {"most", one.most},
          {"tightens_only", one.tightens_only},
          {"meaning", one.meaning}};
}

int list(const ParameterCall& call, bool changed_only) {
  ParameterClient client = client_of(call);
  const std::vector<double> values = client.read();
  if (!call.json) {
    const std::string table = parameter_table(client.parameters(), values, changed_only);
    std::printf("%s", table.empty() ? "all are robot.yaml's\n" : table.c_str());
    return kExitDone;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!changed_only || values[i] != client.parameters()[i].file)
      std::printf("%s\n", parameter_json(client.parameters()[i], values[i]).dump().c_str());
  return kExitDone;
}

int get(const ParameterCall& call) {
  ParameterClient client = client_of(call);
  const std::size_t place = place_named(client, call.name);
  const double value = client.read()[place];
  const Parameter& one = client.parameters()[place];
  if (call.json)
    std::printf("%s\n", parameter_json(one, value).dump().c_str());
  else
    std::printf("%s%s%s\n", exact_text(value).c_str(), one.unit.empty() ? "" : " ", one.unit.c_str());
  return kExitDone;
}

/// "3500" or "3500 N/m", as in robot.yaml; "file" is robot.yaml's own.
double value_of(const Parameter& one, const std::string& text) {
  if (text == "file") return one.file;
  const auto parsed = YamlMap::parse("value: " + text, one.name);
  const bool bare = text.find(' ') == std::string::npos;
  return parsed.quantity("value", bare ? "" : one.unit, one.least, one.most);
}

int set(const ParameterCall& call) {
  ParameterClient client = client_of(call);
  const Parameter& one = client.parameters()[place_named(client, call.name)];
  double value = 0.0;
  try {
    value = value_of(one, call.value);
  } catch (const std::exception& error) {
    throw WrongUse(std::string(error.what()) + (one.tightens_only ? "; a limit may only be tightened" : ""));
  }
  return report_motion("param set", client.set(one, value)) ? kExitDone : kExitFailed;
}

int save(const ParameterCall& call, bool elsewhere) {
  if (elsewhere && call.out.empty())
    throw WrongUse(
        "param save: robot.yaml is on the robot's computer: save there, or here with --out FILE and carry it "
        "there as overlay.yaml beside robot.yaml");
  ParameterClient client = client_of(call);
  const std::vector<OverlaidNumber> numbers = client.overlay(client.read());
  const fs::path path = call.out.empty() ? fs::path(client.robot().folder) / kOverlayFile
                                         : fs::path(call.out);
  if (numbers.empty() && call.out.empty()) {
    fs::remove(path);
    std::printf("all are robot.yaml's: there is no %s\n", path.c_str());
    return kExitDone;
  }
  report::write_text(overlay_text(numbers), path);
  for (const OverlaidNumber& one : numbers) std::printf("%s\n", overlaid_text(one).c_str());
  std::printf("%s%s: the next sprung up reads it\n", path.c_str(),
              call.out.empty() ? "" : ", once it is overlay.yaml beside robot.yaml");
  return kExitDone;
}

void add_call(CommandLine& line, ParameterCall& call, bool json = true) {
  line.option("--instance", call.instance, "which run");
  line.option("--robot", call.robot, "refuse unless this robot is up");
  if (json) line.flag("--json", call.json, "one JSON line for each");
}

}  // namespace

void add_param(CommandLine& sprung, bool elsewhere) {
  const auto call = std::make_shared<ParameterCall>();
  CommandLine& param = sprung.subcommand(
      "param", "Numbers of robot.yaml that change while the robot runs: gains, heights, thresholds, limits.");
  param.example("sprung param list; sprung param set compliance.stiffness.z \"3500 N/m\"; sprung param save");
  CommandLine& all = param.subcommand("list", "All of them: value, unit, range, meaning.");
  add_call(all, *call);
  all.example("sprung param list");
  all.action([=] { return list(*call, false); });

  CommandLine& one = param.subcommand("get", "The value of one.");
  one.option("name", call->name, "as list shows it", Need::kRequired);
  add_call(one, *call);
  one.example("sprung param get compliance.stiffness.z");
  one.action([=] { return get(*call); });

  CommandLine& change = param.subcommand(
      "set", "Another value: reached in a second. The answer names the cycle in which it began.");
  change.option("name", call->name, "as list shows it", Need::kRequired);
  change.option("value", call->value, "with or without its unit; 'file': robot.yaml's", Need::kRequired);
  add_call(change, *call, false);
  change.example("sprung param set compliance.stiffness.z \"3500 N/m\"; sprung param set stand_length 0.5");
  change.action([=] { return set(*call); });

  CommandLine& diff = param.subcommand("diff", "Those that are not robot.yaml's.");
  add_call(diff, *call);
  diff.example("sprung param diff");
  diff.action([=] { return list(*call, true); });

  CommandLine& keep = param.subcommand(
      "save",
      "Keep what is not robot.yaml's as overlay.yaml beside it, which the next sprung up reads and names.");
  keep.option("--out", call->out, "another file instead");
  add_call(keep, *call, false);
  keep.example("sprung param save");
  keep.action([=] { return save(*call, elsewhere); });
}

}  // namespace sprung::commands
