#include "tools/station/gateway/file_parts.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung::gateway {
namespace {

TEST(FileParts, RequestsAndPartsAreReadAsTheyWereWritten) {
  const auto request = parse_request(request_text({"robot/robot.yaml", 1ull << 40}));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->file, "robot/robot.yaml");
  EXPECT_EQ(request->offset, 1ull << 40);
  FilePart part{"a", 3, 9, "", std::string("\n\0{}", 4)};
  const auto read = parse_part(part_text(part));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->bytes, part.bytes);
  EXPECT_EQ(read->total, 9u);
  for (const char* wrong : {"", "{}", "x", R"({"file":1,"offset":0})", R"({"file":"a","offset":-1})", "[]"}) {
    EXPECT_FALSE(parse_request(wrong)) << wrong;
    EXPECT_FALSE(parse_part(std::string(wrong) + "\nxyz")) << wrong;
  }
}

TEST(FileParts, PartsOfATextAndOfAFileMakeItWhole) {
  std::string whole;
  for (int k = 0; k < 1000; ++k) whole += std::to_string(k);
  const test::OwnFolder folder("parts");
  const std::string path = folder.path() / "file";
  std::ofstream(path, std::ios::binary) << whole;
  std::string by_text, by_file;
  while (by_text.size() < whole.size()) {
    by_text += part_of({"f", by_text.size()}, whole).bytes;
    const FilePart part = read_part({"f", by_file.size()}, path);
    EXPECT_EQ(part.total, whole.size());
    EXPECT_LE(part.bytes.size(), kPartBytes);
    by_file += part.bytes;
  }
  EXPECT_EQ(by_text, whole);
  EXPECT_EQ(by_file, whole);
  EXPECT_EQ(read_part({"f", whole.size() + 5}, path).bytes, "");
  EXPECT_EQ(part_of({"f", whole.size() + 5}, whole).bytes, "");
  EXPECT_NE(read_part({"f", 0}, path + ".none").error, "");
}

TEST(FileParts, ANameIsNoWayOutOfAFolder) {
  for (const char* good : {"robot.yaml", "a b", "x..y"}) EXPECT_TRUE(is_plain_name(good)) << good;
  for (const char* wrong : {"", ".", "..", "../x", "/etc/passwd", "a/b", ".key"})
    EXPECT_FALSE(is_plain_name(wrong)) << wrong;
  EXPECT_FALSE(is_plain_name(std::string_view("a\0b", 3)));
}

}  // namespace
}  // namespace sprung::gateway
