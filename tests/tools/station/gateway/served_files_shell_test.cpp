#include "tools/station/gateway/served_files_shell.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung::gateway {
namespace {

TEST(ServedFiles, PartsOfAFileMakeItWhole) {
  std::string whole, parts;
  for (int k = 0; k < 1000; ++k) whole += std::to_string(k);
  const test::OwnFolder folder("parts");
  const std::string path = folder.path() / "file";
  std::ofstream(path, std::ios::binary) << whole;
  while (parts.size() < whole.size()) {
    const FilePart part = read_part({"f", parts.size()}, path);
    EXPECT_EQ(part.total, whole.size());
    EXPECT_LE(part.bytes.size(), kPartBytes);
    ASSERT_FALSE(part.bytes.empty());
    parts += part.bytes;
  }
  EXPECT_EQ(parts, whole);
  EXPECT_EQ(read_part({"f", whole.size() + 5}, path).bytes, "");
  EXPECT_NE(read_part({"f", 0}, path + ".none").error, "");
}

}  // namespace
}  // namespace sprung::gateway
