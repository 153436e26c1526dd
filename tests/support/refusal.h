#pragma once
/// What somebody who asks for the impossible is told.
#include <stdexcept>
#include <string>

namespace sprung::test {

/// The text of the error that the call throws; "not refused" where it throws none. Other exceptions go on.
template <class Error = std::invalid_argument, class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace sprung::test
