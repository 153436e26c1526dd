#include <poll.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "runtime/utc_text.h"
#include "tools/commands.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/incident/bundle.h"
#include "tools/logs/incident/log_choice.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr int kRecorder_ms = 300;  // it hands over what it has ten times a second

struct IncidentRequest {
  std::string run_or_log;
  std::string out;
  double last_s = 30.0;
};

/// Where the recorder of `sprung up` writes, by itself and as a service.
const std::vector<std::string> kLogFolders = {"logs", "/var/log/sprung"};

/// What is meant: the log, and the run file of the robot that writes it.
log::BundleRequest of_run(const RunInfo& run) {
  if (run.log.empty())
    throw std::runtime_error(
        "robot " + run.robot +
        " is up and writes no log: sprung record FILE.lcm writes one from now on; or name "
        "a log: sprung incident FILE.lcm");
  poll(nullptr, 0, kRecorder_ms);
  log::BundleRequest request;
  request.log = log::newest_part(run.log);
  request.run_file = run_file_path(run.instance);
  return request;
}

log::BundleRequest of_newest_log() {
  log::BundleRequest request;
  request.log = log::newest_log(kLogFolders);
  if (request.log.empty())
    throw std::runtime_error(
        "no robot is up, and no log is in ./logs or /var/log/sprung: name one, sprung incident FILE.lcm");
  return request;
}

/// The default run before any other; several others are for the operator to choose from.
std::optional<RunInfo> run_that_is_up() {
  if (auto run = read_run_file("default")) return run;
  std::vector<RunInfo> runs = runs_that_are_up();
  if (runs.empty()) return std::nullopt;
  std::string names;
  for (const RunInfo& run : runs) names += " " + run.instance;
  if (runs.size() > 1) throw WrongUse("of which run? Name one of:" + names);
  return std::move(runs.front());
}

log::BundleRequest what_is_meant(const std::string& run_or_log) {
  if (run_or_log.empty()) {
    const auto run = run_that_is_up();
    return run ? of_run(*run) : of_newest_log();
  }
  if (const auto run = read_run_file(run_or_log)) return of_run(*run);
  if (!std::filesystem::is_regular_file(run_or_log))
    throw WrongUse(run_or_log + " is neither a log nor a run that is up (sprung up --instance NAME)");
  log::BundleRequest request;
  request.log = run_or_log;
  return request;
}

std::string default_name() {
  std::string when = utc_text(utc_us(), '-');
  for (char& c : when) c = c == ':' ? '-' : c;
  return "incident-" + when + log::kArchiveEnding;
}

int run_incident(const IncidentRequest& request) {
  if (!(request.last_s > 0.0)) throw WrongUse("--last is more than 0 s");
  log::BundleRequest meant = what_is_meant(request.run_or_log);
  meant.last_s = request.last_s;
  meant.out = request.out.empty() ? default_name() : request.out;
  const log::Bundle bundle = log::write_bundle(meant, progress_line("incident"));
  std::string files;
  for (const std::string& file : bundle.files) files += (files.empty() ? "" : ", ") + file;
  std::printf("%s: %s\n%s", meant.out.c_str(), files.c_str(), bundle.cause.c_str());
  return kExitDone;
}

}  // namespace

void add_incident(CommandLine& sprung) {
  const auto request = std::make_shared<IncidentRequest>();
  CommandLine& incident = sprung.subcommand(
      "incident",
      "What somebody needs who looks at an incident: end of the log, cause, robot.yaml, versions, lines.");
  incident.option("run_or_log", request->run_or_log,
                  "an LCM log, or the --instance of a robot that is up; default: the robot that is up, else "
                  "the newest log in ./logs and /var/log/sprung");
  incident.option("--last", request->last_s, "seconds of the robot's time before the log's end");
  incident.option("-o,--out", request->out,
                  "NAME.tar.gz, any other name is a folder; default: incident-DATE-TIME.tar.gz, here");
  incident.example("sprung incident --last 60");
  incident.action([=] { return run_incident(*request); });
}

}  // namespace sprung::commands
