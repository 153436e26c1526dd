#pragma once
/// What a command takes, as values: one source for --help, completion, man page and the test that every
/// command has an example.
#include <string>
#include <vector>

namespace sprung {

struct OptionInfo {
  std::string name;  ///< "--count", "-h,--help", or without dashes for a positional
  std::string help;
  std::string default_text;          ///< empty = none
  std::vector<std::string> allowed;  ///< empty = any
  bool flag = false;                 ///< takes no value
  bool positional = false;
  bool required = false;
  bool repeated = false;  ///< may be given several times, or takes several values
};

struct CommandInfo {
  std::string name;  ///< of itself alone: "dump", not "sprung can dump"
  std::string description;
  std::string example;
  std::vector<OptionInfo> options;
  std::vector<CommandInfo> subcommands;
};

}  // namespace sprung
