#include "tools/operate/help/command_json.h"

#include <nlohmann/json.hpp>

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const OptionInfo& option) {
  return {{"name", option.name},         {"help", option.help},        {"default", option.default_text},
          {"allowed", option.allowed},   {"flag", option.flag},        {"positional", option.positional},
          {"required", option.required}, {"repeated", option.repeated}};
}

Json to_json(const CommandInfo& command) {
  Json out{{"name", command.name}, {"description", command.description}, {"example", command.example}};
  out["options"] = Json::array();
  for (const OptionInfo& option : command.options) out["options"].push_back(to_json(option));
  out["subcommands"] = Json::array();
  for (const CommandInfo& sub : command.subcommands) out["subcommands"].push_back(to_json(sub));
  return out;
}

}  // namespace

std::string command_json(const CommandInfo& program) { return to_json(program).dump(1) + "\n"; }

}  // namespace sprung
