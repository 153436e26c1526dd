#include "tools/station/gateway/via_shell.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/command_line.h"
#include "tools/station/gateway/operator_register_shell.h"

namespace sprung::gateway {
namespace {

/// What an operator says or looks at; all else belongs to files, buses and processes of the robot's computer.
constexpr std::array<std::string_view, 20> kFromElsewhere{
    "stand", "sit", "jump",   "comply", "land", "walk", "stop", "estop", "clear",    "status",
    "watch", "spy", "topics", "record", "hold", "home", "move", "param", "drive-by", "console"};
constexpr std::string_view kHandOver = "hand-over", kFetch = "fetch";

}  // namespace

Via take_via(int argc, const char* const* argv) {
  Via out;
  bool any = false;
  int i = 1;
  out.words.push_back(argv[0]);
  for (; i < argc && argv[i][0] == '-'; ++i) {
    const std::string_view word = argv[i];
    if (word == "--encrypt") {
      any = out.hidden = true;
      continue;
    }
    if (word != "--via" && word != "--key") break;
    if (i + 1 >= argc) throw WrongUse(std::string(word) + " needs a value");
    (word == "--via" ? out.host : out.key) = argv[++i];
    any = true;
  }
  out.words.insert(out.words.end(), argv + i, argv + argc);
  if (!any) return out;
  if (out.host.empty()) throw WrongUse("--key and --encrypt go with --via HOST");
  if (out.key.empty()) out.key = operator_key_path();
  if (i >= argc) throw WrongUse("--via HOST stands before a command: sprung --via HOST status");
  const std::string_view command = argv[i];
  const bool help = std::any_of(out.words.begin(), out.words.end(), [](const char* word) {
    return std::string_view(word) == "--help" || std::string_view(word) == "-h";
  });
  if (help) out.host.clear();
  out.emergency = !help && command == "estop";
  out.files_alone = !help && command == kFetch;
  if (!help && command != kHandOver && command != kFetch &&
      std::find(kFromElsewhere.begin(), kFromElsewhere.end(), command) == kFromElsewhere.end())
    throw WrongUse("sprung " + std::string(command) + " is of the robot's own computer, not --via another");
  return out;
}

}  // namespace sprung::gateway
