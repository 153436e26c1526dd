#include <sprung_version.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "robots/robot_loader.h"
#include "runtime/command_info.h"
#include "tools/commands.h"
#include "tools/operate/help/command_json.h"
#include "tools/operate/help/completion.h"
#include "tools/operate/help/man_page.h"
#include "tools/operate/launcher/installed_release.h"

namespace sprung::commands {

namespace {

/// Every robot beside this one.
std::vector<std::string> robot_names() {
  std::set<std::string> names;
  std::error_code none;
  const auto folder = std::filesystem::path(robot_folder("single_leg")).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (std::filesystem::exists(entry.path() / "robot.yaml", none))
      names.insert(entry.path().filename().string());
  }
  return {names.begin(), names.end()};
}

}  // namespace

void add_help(CommandLine& sprung) {
  CommandLine& completion = sprung.subcommand("completion",
                                              "A script that lets the shell complete commands and options.");
  CommandLine& bash = completion.subcommand("bash", "For bash; installed with sprung.");
  completion.example("source <(sprung completion bash)");
  bash.example("source <(sprung completion bash)      in ~/.bashrc, where sprung is not installed");
  bash.action([&sprung] {
    std::printf("%s", bash_completion(sprung.info(), robot_names()).c_str());
    return kExitDone;
  });
  const auto as_json = std::make_shared<bool>(false);
  CommandLine& man = sprung.subcommand("man", "The manual page, all commands in one, as roff.");
  man.flag("--json", *as_json, "the commands as data instead");
  man.example("sprung man | man -l -");
  man.action([&sprung, as_json] {
    const std::string version = std::string(SPRUNG_VERSION) + " (" + SPRUNG_GIT_HASH + ")";
    std::printf("%s", (*as_json ? command_json(sprung.info()) : man_page(sprung.info(), version)).c_str());
    return kExitDone;
  });
  CommandLine& version = sprung.subcommand(
      "version", "Version, build and message types, which an installation keeps to be checked.");
  version.example("sprung version; cat /usr/share/sprung/release      # the same, or `sprung up` says so");
  version.action([] {
    std::printf("%s", release_text().c_str());
    return kExitDone;
  });
}

}  // namespace sprung::commands
