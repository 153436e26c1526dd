#include "tests/support/paths.h"

namespace sprung::test {

std::string source_dir() { return SPRUNG_SOURCE_DIR; }
std::string bin_dir() { return SPRUNG_BIN_DIR; }

}  // namespace sprung::test
