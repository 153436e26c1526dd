#include "tools/can/commission/terminal_person.h"

#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "robots/yaml_reader.h"
#include "runtime/command_line.h"
#include "runtime/stop_request.h"

namespace sprung::commission {
namespace {

constexpr double kNobody = std::numeric_limits<double>::quiet_NaN();

/// A line from the terminal; false at its end and after Ctrl-C.
bool read_line(char (&line)[64]) {
  pollfd waits[2] = {{STDIN_FILENO, POLLIN, 0}, {stop_fd(), POLLIN, 0}};
  poll(waits, stop_fd() >= 0 ? 2 : 1, -1);
  if (stop_requested()) return false;
  return std::fgets(line, sizeof line, stdin) != nullptr;
}

}  // namespace

TerminalPerson::TerminalPerson(const std::string& answers_file, bool yes, bool prints)
    : yes_(yes), prints_(prints) {
  if (answers_file.empty()) return;
  const YamlMap file = YamlMap::load(answers_file);
  for (const auto& word : kWords<Ask>)
    if (file.has(word.name)) answers_[word.value] = file.quantity(word.name, "", -1e6, 1e6);
  file.finish();
}

double TerminalPerson::answer(const Question& question) {
  const auto known = answers_.find(question.ask);
  if (known != answers_.end()) return known->second;
  if (yes_ && question.ask != Ask::kPower) return question.suggested;
  if (isatty(STDIN_FILENO) == 0)
    throw WrongUse(question.text + " Nobody to ask here: put `" + name(question.ask) + ": " +
                   std::to_string(question.suggested) + "` into the file of --answers");
  std::printf("\n%s\n[%s] Enter for %g, a number, or s to leave this step: ", question.text.c_str(),
              name(question.ask), question.suggested);
  std::fflush(stdout);
  char line[64] = "";
  if (!read_line(line) || line[0] == 's') return kNobody;
  char* end = nullptr;
  const double value = std::strtod(line, &end);
  if (end != line) return value;
  return question.ask == Ask::kPower ? kNobody : question.suggested;  // power is never the answer of an Enter
}

void TerminalPerson::hears(const std::string& text) {
  if (prints_) std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace sprung::commission
