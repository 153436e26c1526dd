#pragma once
/// Where this checkout and the programs of this build are. Functions of one small source, so that no other
/// test has a path in it: what one clone has compiled serves another.
#include <string>

namespace sprung::test {

std::string source_dir();  ///< the top folder, without a slash at its end
std::string bin_dir();     ///< of programs, likewise

}  // namespace sprung::test
