#include "tools/logs/commands/replay.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>

#include "runtime/node.h"
#include "signals/number_text.h"
#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/replay/difference_report.h"
#include "tools/logs/replay/lcm_replay.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

struct ReplayOptions {
  std::string log;
  std::string into;
  std::string other;
  std::string robot;
  std::string preset;
  double start_s = 0.0;
  double duration_s = 0.0;
  double speed = 1.0;
  bool loop = false;
  bool step = false;
  std::vector<std::string> channels;
  std::vector<std::string> remaps;
  std::string lcm_url = kDefaultLcmUrl;
  std::string out;
  std::string html;
  bool as_json = false;

  double duration() const { return duration_s > 0.0 ? duration_s : std::numeric_limits<double>::infinity(); }
};

/// That makes the page again.
std::string command_of(const ReplayOptions& options) {
  std::string line = "sprung replay " + options.log + " --into " + options.into + " --html " + options.html;
  if (!options.robot.empty()) line += " --robot " + options.robot;
  if (!options.preset.empty()) line += " --preset " + options.preset;
  if (options.start_s > 0.0) line += " --start " + number_text(options.start_s);
  if (options.duration_s > 0.0) line += " --duration " + number_text(options.duration_s);
  return line;
}

int run_into(const ReplayOptions& options) {
  ReplayRequest request;
  request.log = options.log;
  request.robot = options.robot;
  request.preset = options.preset;
  request.from_s = options.start_s;
  request.to_s = options.start_s + options.duration();
  request.out = options.out;
  request.courses = !options.html.empty();
  try {
    request.cores = core_choice(options.into);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(std::string("--into: ") + error.what());
  }
  const ReplayResult result = or_wrong_use([&] {
    if (!options.html.empty()) log::refuse_same_file({options.log}, options.html);
    ProgressBar bar("replay, MB");
    return run_replay(request, [&bar](std::uint64_t done, std::uint64_t all) {
      bar.show(done / 1'000'000, all / 1'000'000);
    });
  });
  std::printf("%s",
              (options.as_json ? replay_json(request, result) + "\n" : replay_text(request, result)).c_str());
  if (!options.html.empty())
    report::write_report(replay_page(request, result, command_of(options)), options.html);
  return result.identical() ? kExitDone : kExitFailed;
}

/// Address and port of a network; what follows is how one computer uses it.
std::string network_of(const std::string& lcm_url) { return lcm_url.substr(0, lcm_url.find('?')); }

/// A robot that is up on this network would hear two of everything.
void refuse_live_network(const ReplayOptions& options) {
  for (const RunInfo& running : runs_that_are_up()) {
    if (network_of(running.lcm_url) != network_of(options.lcm_url)) continue;
    throw WrongUse(running.robot + " is up on " + running.lcm_url + " (instance '" + running.instance +
                   "'): sprung down first, or replay onto another network with --lcm-url");
  }
}

/// On the terminal: Enter goes on, q ends.
bool ask_for_step(double time_s) {
  std::printf("%.4f s; Enter: next, q: end ", time_s);
  std::fflush(stdout);
  std::string line;
  return static_cast<bool>(std::getline(std::cin, line)) && line != "q";
}

int run_to_lcm(const ReplayOptions& options) {
  refuse_live_network(options);
  LcmReplayRequest request;
  request.log = options.log;
  request.lcm_url = options.lcm_url;
  request.start_s = options.start_s;
  request.duration_s = options.duration();
  request.speed = options.speed;
  request.loop = options.loop;
  request.channels = options.channels;
  request.remaps = options.remaps;
  std::printf("%s onto %s at %s x; Ctrl-C ends it\n", options.log.c_str(), options.lcm_url.c_str(),
              number_text(options.speed).c_str());
  std::fflush(stdout);
  const LcmReplayResult result = or_wrong_use(
      [&] { return replay_to_lcm(request, options.step ? StepGate(ask_for_step) : StepGate()); });
  std::printf("sent %lld messages\n", static_cast<long long>(result.messages));
  if (result.messages == 0) std::fprintf(stderr, "the log has no such message in that time\n");
  for (const std::string& name : result.not_renamed)
    std::fprintf(stderr, "--remap %s=...: no message of that channel was sent\n", name.c_str());
  if (result.failed > 0)
    std::fprintf(stderr, "LCM did not take %lld of them: run 'sprung doctor'\n",
                 static_cast<long long>(result.failed));
  return result.messages > 0 && result.failed == 0 ? kExitDone : kExitFailed;
}

/// Of three ways to replay each has options of its own; one that would change nothing is no help to anyone.
void refuse_what_goes_unused(const ReplayOptions& o) {
  const ReplayOptions plain;
  const bool onto_lcm = o.into.empty() && o.other.empty();
  if (!o.into.empty() && !o.other.empty()) throw WrongUse("--into CORES or --diff LOG, not both");
  if (!onto_lcm &&
      (o.loop || o.step || !o.remaps.empty() || o.speed != plain.speed || o.lcm_url != plain.lcm_url))
    throw WrongUse(
        "--speed, --loop, --step, --remap and --lcm-url are for a replay onto LCM: leave out these, or "
        "--into "
        "and --diff");
  if (o.into.empty() && !(o.robot.empty() && o.preset.empty() && o.out.empty() && !o.as_json))
    throw WrongUse("--robot, --preset, --out and --json need --into CORES");
  if (onto_lcm && !o.html.empty()) throw WrongUse("--html needs --into CORES or --diff LOG");
  if (!o.into.empty() && !o.channels.empty())
    throw WrongUse(
        "--channels is for a replay onto LCM and for --diff: --into compares all that its cores make");
}

int run_replay_command(const ReplayOptions& options) {
  if (!(options.start_s >= 0.0 && options.duration_s >= 0.0 && options.speed >= 0.0))
    throw WrongUse("--start, --duration and --speed are 0 or more");
  refuse_what_goes_unused(options);
  if (!options.other.empty())
    return run_diff(
        {options.log, options.other, options.channels, options.start_s, options.start_s + options.duration()},
        options.html);
  if (!options.into.empty()) return run_into(options);
  return run_to_lcm(options);
}

}  // namespace

void add_replay(CommandLine& sprung) {
  const auto o = std::make_shared<ReplayOptions>();
  CommandLine& replay = sprung.subcommand(
      "replay", "Send a log onto an LCM network again, or run the cores on it and compare what they say.");
  replay.option("log", o->log, "LCM log", Need::kRequired);
  replay.option(
      "--into", o->into,
      "run these cores on the log, as fast as it goes, and compare: estimator,planner,controller or "
      "some of them");
  replay.option("--robot", o->robot,
                "with --into: another robot.yaml, a folder or a name; default: the log's own");
  replay.option("--preset", o->preset, "with --into: another preset; default: the log's own");
  replay.option("--out", o->out, "with --into: LCM log of what the cores say now");
  replay.option("--diff", o->other, "compare with this other log, as sprung log diff");
  replay.option("--html", o->html, "with --into or --diff: a page with tables and plots of the differences");
  replay.flag("--json", o->as_json, "with --into: one JSON object on standard output");
  replay.option("--start", o->start_s, "seconds of the robot's time since the begin of the log");
  replay.option("--duration", o->duration_s, "seconds; 0 = to the end");
  replay.option("--speed", o->speed,
                "onto LCM: times real time, 0 = as fast as it goes (LCM loses some above 5)");
  replay.flag("--loop", o->loop, "onto LCM: again and again");
  replay.flag("--step", o->step, "onto LCM: cycle by cycle, Enter for the next");
  replay.option("--channels", o->channels, "which: NAME, GLOB_* or /regular expression/; may be repeated");
  replay.option("--remap", o->remaps, "onto LCM: OLD=NEW, another name for a channel; may be repeated");
  replay.option("--lcm-url", o->lcm_url, "onto LCM: the network");
  replay.example("sprung replay logs/pegasus.lcm --into estimator,planner,controller --robot other.yaml");
  replay.action([=] { return run_replay_command(*o); });
}

}  // namespace sprung::commands
