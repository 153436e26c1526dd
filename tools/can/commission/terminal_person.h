#pragma once
/// The person at the terminal, or a file of answers in their place. Shell.
#include <map>
#include <string>

#include "tools/can/commission/drive_port.h"

namespace sprung::commission {

class TerminalPerson final : public Person {
 public:
  /// @param answers_file "" = none. A YAML map: `turn: 0.2` and so on, by the questions' names; what it does
  /// not name is asked. @param yes takes what is suggested, but for power. @throws ConfigError on a name that
  /// is no question's or a value that is no number.
  TerminalPerson(const std::string& answers_file, bool yes, bool prints);

  /// @throws WrongUse where nobody can be asked, naming the answer that the file lacks.
  double answer(const Question& question) override;
  void begins(const std::string&) override {}
  void hears(const std::string& text) override;

 private:
  std::map<Ask, double> answers_;
  bool yes_, prints_;
};

}  // namespace sprung::commission
