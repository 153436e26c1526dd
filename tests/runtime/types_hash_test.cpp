#include "runtime/types_hash.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/support/paths.h"

namespace sprung {
namespace {

std::string read_all(const std::string& path) {
  std::ifstream in(test::source_dir() + "/" + path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(TypesHash, IsOneNumber) {
  EXPECT_EQ(types_hash(), types_hash());
  EXPECT_NE(types_hash(), 0);
}

/// A type that is left out could differ without being noticed.
TEST(TypesHash, CoversTheTypeOfEveryChannelThatProcessesExchange) {
  const std::string source = read_all("runtime/types_hash.cpp");
  const std::string table = read_all("lcmtypes/README.md");
  const std::regex row(R"(\| [A-Z_]+ \| `(\w+_t)` \|)");
  int types = 0;
  for (auto it = std::sregex_iterator(table.begin(), table.end(), row); it != std::sregex_iterator(); ++it) {
    const std::string type = (*it)[1];
    if (type.rfind("log_", 0) == 0) continue;  // in log files alone
    EXPECT_NE(source.find(type), std::string::npos) << type;
    ++types;
  }
  EXPECT_GE(types, 15);
}

}  // namespace
}  // namespace sprung
