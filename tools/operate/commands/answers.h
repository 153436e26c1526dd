#pragma once
/// Asking the operator, and telling what the robot answered.
#include <optional>
#include <string>

#include "tools/operate/client/operator_client.h"

namespace sprung::commands {

/// Asks on the terminal; `yes` answers for the operator. @throws WrongUse where nobody can be asked, naming
/// --yes.
bool confirmed(const std::string& question, bool yes);

/// One line: on standard output what went well, on standard error what did not, or that nobody answers.
/// @return whether it went well.
bool report_answer(const char* what, const std::optional<OperatorAnswer>& answer);

/// The same for what the motion planner answers, with the cycle; after a stop request it says that the robot
/// goes on.
bool report_motion(const char* what, const std::optional<OperatorAnswer>& answer);

}  // namespace sprung::commands
