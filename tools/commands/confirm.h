#pragma once
#include <string>

namespace sprung::commands {

/// Asks on the terminal; `yes` answers for the operator. @throws WrongUse where nobody can be asked, naming --yes.
bool confirmed(const std::string& question, bool yes);

}  // namespace sprung::commands
