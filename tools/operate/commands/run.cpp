#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/key_source.h"
#include "tools/commands.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

/// What a program needs to take part, but for the key none of it is secret.
void describe(const RunInfo& info, int key_fd) {
  setenv(kKeyFdVariable, std::to_string(key_fd).c_str(), 1);
  setenv("SPRUNG_SESSION", std::to_string(info.session).c_str(), 1);
  setenv("SPRUNG_EPOCH_US", std::to_string(info.epoch_us).c_str(), 1);
  setenv("SPRUNG_LCM_URL", info.lcm_url.c_str(), 1);
}

/// Becomes that program: its exit status is ours.
int run_with_key(const std::string& instance, std::vector<std::string> words) {
  const RunInfo info = require_running(instance, "");
  const KeyFd key(*read_key_file(run_key_path(instance)));
  describe(info, key.number());
  KeyFd::inherit(key.number());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  throw std::runtime_error("cannot start " + words[0] + ": " + std::strerror(errno));
}

}  // namespace

void add_run(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  const auto words = std::make_shared<std::vector<std::string>>();
  CommandLine& run = sprung.subcommand(
      "run", "Starts a program of your own that may command the robot: it gets the run's key.");
  run.option("--instance", *instance, "which run");
  run.option("program", *words, "after --: the program and its arguments", Need::kRequired);
  run.example("sprung run -- ./my_planner");
  run.action([=] { return run_with_key(*instance, *words); });
}

}  // namespace sprung::commands
