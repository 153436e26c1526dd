#pragma once
/// A command to its end.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/support/paths.h"

namespace sprung::test {

struct CommandEnd {
  int status = -1;
  std::string output;  ///< standard output and error
};

inline CommandEnd run_command(const std::string& command) {
  CommandEnd end;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return end;
  std::array<char, 4096> buffer{};
  for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    end.output.append(buffer.data(), count);
  const int status = pclose(pipe);
  end.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return end;
}

/// `sprung ARGUMENTS` of this build.
inline CommandEnd run_sprung(const std::string& arguments) {
  return run_command(test::bin_dir() + "/sprung " + arguments);
}

}  // namespace sprung::test
