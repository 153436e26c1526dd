/// sprung: the operator's and the engineer's one command.
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/operate/commands/installed_robots.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/station/gateway/remote_robot_shell.h"
#include "tools/station/gateway/via_shell.h"

namespace {

/// Whether standard output is a pipe whose reader has gone, `| head` for one: it has read what it wanted.
bool reader_left() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

/// A command whose answer nobody could read has failed: a full disk behind `sprung log info x.lcm > y.txt`.
int or_unsaid(int status) {
  const bool said = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (said || status != sprung::kExitDone || reader_left()) return status;
  std::fprintf(stderr, "sprung: not all could be written to standard output: is its disk full?\n");
  return sprung::kExitFailed;
}

int run_command(const sprung::gateway::Via& via, sprung::gateway::RemoteRobot* remote) {
  using namespace sprung::commands;
  sprung::CommandLine line("sprung", "Virtual springs for geared, torque-sensorless legged robots.");
  line.example(
      "sprung up single_leg --sim      then, in a second terminal: sprung stand; sprung jump; sprung down\n"
      "  sprung --via HOST stand         a robot on another computer: docs/remote.md");
  // Taken off before the others are read (via.h); here so that --help tells of them.
  std::string host = via.host, key = via.key;
  bool hidden = via.hidden;
  line.option("--via", host, "HOST or HOST:PORT of a robot's gateway: the command is for the robot there");
  line.option("--key", key, "with --via: file of the operator's key");
  line.flag("--encrypt", hidden, "with --via: nobody on the way reads what the robot says");
  add_up(line);
  add_down(line);
  add_motion(line);
  add_safety(line);
  add_status(line);
  add_topics(line);
  add_watch(line);
  add_spy(line);
  add_play(line);
  add_record(line);
  add_replay(line);
  add_experiment(line);
  add_bench(line);
  add_campaign(line);
  add_can(line);
  add_console(line);
  add_drive(line);
  add_drive_by(line);
  add_hold(line);
  add_home(line);
  add_identify(line);
  add_incident(line);
  add_log(line);
  add_move(line);
  add_param(line, remote != nullptr);
  add_operator(line);
  add_hand_over(line, remote);
  add_fetch(line, {via.host, via.key, via.hidden});
  add_robot(line);
  add_run(line);
  add_study(line);
  add_fault(line);
  add_doctor(line);
  add_help(line);
  return or_unsaid(line.run(static_cast<int>(via.words.size()), via.words.data()));
}

int stop_elsewhere(const sprung::gateway::RemoteOptions& options) {
  const std::string answer = sprung::gateway::stop_in_emergency(options);
  std::printf("estop: %s\n", answer.empty() ? "nobody answered" : answer.c_str());
  return answer == "accepted" || answer == "done" ? sprung::kExitDone : sprung::kExitFailed;
}

int failed(const std::exception& error, int status) {
  std::fprintf(stderr, "sprung: %s\n", error.what());
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  sprung::install_stop_signals();
  sprung::commands::use_installed_robots(sprung::program_folder());
  try {
    const sprung::gateway::Via via = sprung::gateway::take_via(argc, argv);
    const sprung::gateway::RemoteOptions there{via.host, via.key, via.hidden};
    if (!via.host.empty() && via.emergency) return stop_elsewhere(there);
    std::unique_ptr<sprung::gateway::RemoteRobot> remote;
    if (!via.host.empty() && !via.files_alone) remote = std::make_unique<sprung::gateway::RemoteRobot>(there);
    return run_command(via, remote.get());
  } catch (const sprung::WrongUse& error) {
    return failed(error, sprung::kExitWrongUse);
  } catch (const std::exception& error) {
    return failed(error, sprung::kExitFailed);
  }
}
