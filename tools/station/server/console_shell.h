#pragma once
/// The live page, served: the robot's network on one side, pages on the other, the session between them.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "tools/operate/launcher/run_file.h"
#include "tools/station/server/web_server_shell.h"

namespace sprung::station {

struct ConsoleOptions {
  int port = 0;                            ///< 0: any that is free
  std::vector<std::string> other_origins;  ///< of pages from elsewhere that may connect too
};

struct ConsoleAddress {
  std::string url;  ///< with the token
  int port = 0;
};

/// Until a stop is requested or the run ends. @param ready is called once, when pages can be opened.
/// @return why it ended: "" on a stop request. @throws std::runtime_error when it cannot begin.
std::string serve_console(const RunInfo& info, const ConsoleOptions& options,
                          const std::function<void(const ConsoleAddress&)>& ready);

}  // namespace sprung::station
