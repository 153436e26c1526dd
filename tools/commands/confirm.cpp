#include "tools/commands/confirm.h"

#include <unistd.h>

#include <cstdio>

#include "runtime/command_line.h"

namespace sprung::commands {

bool confirmed(const std::string& question, bool yes) {
  if (yes) return true;
  if (isatty(STDIN_FILENO) == 0) throw WrongUse(question + " Nobody to ask here: add --yes");
  std::printf("%s [y/N] ", question.c_str());
  std::fflush(stdout);
  char answer[16] = "";
  if (std::fgets(answer, sizeof answer, stdin) == nullptr) return false;
  return answer[0] == 'y' || answer[0] == 'Y';
}

}  // namespace sprung::commands
