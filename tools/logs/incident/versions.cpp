#include <lcm/lcm.h>
#include <sprung_version.h>
#include <sys/utsname.h>

#include <fstream>
#include <string>

#include "tools/logs/incident/bundle.h"

namespace sprung::log {

namespace {

/// "Debian GNU/Linux 12 (bookworm)".
std::string distribution() {
  const std::string key = "PRETTY_NAME=";
  std::ifstream in("/etc/os-release");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    std::string name = line.substr(key.size());
    if (name.size() > 1 && name.front() == '"') name = name.substr(1, name.size() - 2);
    return name;
  }
  return "unknown";
}

}  // namespace

std::string versions_text() {
  utsname machine{};
  uname(&machine);
  const std::string lcm = std::to_string(LCM_MAJOR_VERSION) + "." + std::to_string(LCM_MINOR_VERSION) + "." +
                          std::to_string(LCM_MICRO_VERSION);
  return "sprung        " + std::string(SPRUNG_VERSION) + " (" + SPRUNG_GIT_HASH + ")\n" +  //
         "LCM           " + lcm + "\n" +                                                    //
         "kernel        " + machine.sysname + " " + machine.release + " " + machine.version + " " +
         machine.machine + "\n" +                    //
         "distribution  " + distribution() + "\n" +  //
         "host          " + machine.nodename + "\n";
}

}  // namespace sprung::log
