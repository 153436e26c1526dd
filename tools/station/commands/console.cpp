#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/commands.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/run_folder.h"
#include "tools/station/server/console_shell.h"

namespace sprung::commands {

namespace {

struct ConsoleRequest {
  std::string instance = "default";
  int port = 8137;
  bool open = false;
  std::vector<std::string> origins;
};

/// The token would stand in the list of processes as an argument of the browser: a file of this user's leads
/// there instead.
void open_browser(const std::string& url) {
  const std::string file = made_run_folder() / "console.html";
  const int fd = open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) throw std::runtime_error("cannot write " + file);
  const std::string page = "<!doctype html><meta http-equiv=refresh content='0;url=" + url + "'>";
  const bool written = write(fd, page.data(), page.size()) == static_cast<ssize_t>(page.size());
  close(fd);
  if (!written) throw std::runtime_error("cannot write " + file);
  ChildProcess("/bin/sh", {"-c", "xdg-open '" + file + "' >/dev/null 2>&1 &"}).wait(2.0);
}

int run_console(const ConsoleRequest& request) {
  if (request.port < 0 || request.port > 65535) throw WrongUse("--port is 0 to 65535");
  const RunInfo info = require_running(request.instance, "");
  const auto ready = [&](const station::ConsoleAddress& address) {
    std::printf("console of %s: %s\n", info.robot.c_str(), address.url.c_str());
    std::printf(
        "on this machine alone; from another one: ssh -L %d:127.0.0.1:%d THIS_MACHINE, then the same\n",
        address.port, address.port);
    std::printf("who has the address can command the robot; Ctrl-C ends the page, not the robot\n");
    std::fflush(stdout);
    if (request.open) open_browser(address.url);
  };
  const std::string why = station::serve_console(info, {request.port, request.origins}, ready);
  if (!why.empty()) std::printf("console: ended: %s\n", why.c_str());
  return kExitDone;
}

}  // namespace

void add_console(CommandLine& sprung) {
  const auto request = std::make_shared<ConsoleRequest>();
  CommandLine& console = sprung.subcommand(
      "console", "Serves a page with the robot live and every command: to be opened in a browser.");
  console.option("--instance", request->instance, "which run");
  console.option("--port", request->port, "on 127.0.0.1 and ::1; 0 = any that is free");
  console.flag("--open", request->open, "open it in the desktop's browser");
  console.option("--allow-origin", request->origins,
                 "of a page from elsewhere that may look, e.g. https://app.foxglove.dev; once for each");
  console.example("sprung console --open");
  console.action([=] { return run_console(*request); });
}

}  // namespace sprung::commands
