#include "tools/operate/commands/jump_mode.h"

#include "runtime/command_line.h"

namespace sprung::commands {
namespace {

constexpr JumpMode kModes[] = {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kOwn};

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const JumpMode mode : kModes) out.emplace_back(name(mode));
  return out;
}

}  // namespace

const std::vector<std::string>& jump_mode_names() {
  static const std::vector<std::string> all = names();
  return all;
}

JumpMode jump_mode(const std::string& name) {
  for (const JumpMode mode : kModes) {
    if (name == sprung::name(mode)) return mode;
  }
  throw WrongUse("no mode '" + name + "'");
}

}  // namespace sprung::commands
