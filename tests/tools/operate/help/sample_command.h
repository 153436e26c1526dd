#pragma once
/// A command line with one of everything.
#include <string>
#include <vector>

#include "runtime/command_info.h"
#include "runtime/command_line.h"

namespace sprung::test {

struct SampleCommand {
  SampleCommand() {
    line.example("leg jump");
    CommandLine& jump = line.subcommand("jump", "Jump on the spot.");
    jump.option("robot", robot, "who jumps", Need::kRequired);
    jump.option("-c,--count", count, "how many jumps");
    jump.choice("--clock", clock, {"realtime", "lockstep"}, "who paces");
    jump.flag("--forward", forward, "not on the spot");
    jump.example("leg jump single_leg --count 3");
    CommandLine& can = line.subcommand("can", "Buses.");
    CommandLine& dump = can.subcommand("dump", "Frames in words.");
    dump.option("--filter", filters, "what to show");
    dump.example("leg can dump --filter emcy");
  }
  std::string robot;
  int count = 1;
  std::string clock = "realtime";
  bool forward = false;
  std::vector<std::string> filters;
  CommandLine line{"leg", "A leg - and \\more."};
};

}  // namespace sprung::test
