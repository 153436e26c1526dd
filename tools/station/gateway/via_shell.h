#pragma once
/// `--via HOST` in front of a command: which robot it is for.
#include <string>
#include <vector>

namespace sprung::gateway {

struct Via {
  std::string host;  ///< empty: the command is for this computer
  std::string key;
  bool hidden = false;
  std::vector<const char*> words;  ///< the command line without them
  bool emergency = false;          ///< the command is estop
  bool files_alone = false;        ///< fetch: of a robot that need not be up
};

/// Takes `--via HOST`, `--key FILE` and `--encrypt` from before the command. @throws WrongUse on a value that
/// is missing, and on a command that needs to be on the robot's computer.
Via take_via(int argc, const char* const* argv);

}  // namespace sprung::gateway
