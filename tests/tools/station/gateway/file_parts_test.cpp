#include "tools/station/gateway/file_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sprung::gateway {
namespace {

TEST(FileParts, RequestsAndPartsAreReadAsTheyWereWritten) {
  const auto request = parse_request(request_text({"robot/robot.yaml", 1ull << 40, 7}));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->file, "robot/robot.yaml");
  EXPECT_EQ(request->offset, 1ull << 40);
  EXPECT_EQ(request->parts, 7u);
  EXPECT_FALSE(parse_request(request_text({"f", 0, 0})));
  EXPECT_FALSE(parse_request(request_text({"f", 0, kMostParts + 1})));
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

TEST(FileParts, PartsOfATextMakeItWhole) {
  std::string whole, parts;
  for (int k = 0; k < 1000; ++k) whole += std::to_string(k);
  while (parts.size() < whole.size()) parts += part_of({"f", parts.size()}, whole).bytes;
  EXPECT_EQ(parts, whole);
  EXPECT_EQ(part_of({"f", whole.size() + 5}, whole).bytes, "");
}

TEST(FileParts, AreAssembledInWhateverOrderTheyComeAndAskedForAgainWhereTheyDoNot) {
  std::string whole;
  for (int k = 0; k < 40000; ++k) whole += std::to_string(k);
  std::mt19937 random(1);
  FileAssembly assembly("f");
  std::vector<FilePart> on_the_way;
  int asked = 0;
  for (std::int64_t now_us = 0; !assembly.whole(); now_us += 50'000) {
    ASSERT_LT(now_us, 100'000'000);
    for (const PartRequest& request : assembly.due(now_us)) {
      EXPECT_LE(request.parts, kMostParts);
      for (std::size_t part = 0; part < request.parts; ++part, ++asked)
        if (random() % 5 != 0)
          on_the_way.push_back(part_of({"f", request.offset + part * kPartBytes}, whole));
    }
    std::shuffle(on_the_way.begin(), on_the_way.end(), random);
    for (std::size_t k = 0; k < 3 && !on_the_way.empty(); ++k, on_the_way.pop_back())
      EXPECT_TRUE(assembly.take(on_the_way.back()));
    EXPECT_TRUE(assembly.take({"another", 0, 1, "no", "x"})) << "of another file";
  }
  EXPECT_EQ(assembly.bytes(), whole);
  EXPECT_LT(asked, 2 * static_cast<int>(whole.size() / kPartBytes));
}

TEST(FileParts, GoOnBehindWhatIsThereAlreadyAndAreTakenAsTheyCome) {
  std::string whole;
  for (int k = 0; k < 5000; ++k) whole += std::to_string(k);
  std::string file = whole.substr(0, 3000);
  FileAssembly assembly("f", file.size());
  for (int round = 0; !assembly.whole(); ++round) {
    ASSERT_LT(round, 100);
    for (const PartRequest& request : assembly.due(round * 1'000'000))
      for (std::size_t part = 0; part < request.parts; ++part)
        EXPECT_TRUE(assembly.take(part_of({"f", request.offset + part * kPartBytes}, whole)));
    file += assembly.take_bytes();
    EXPECT_EQ(assembly.there(), file.size());
  }
  EXPECT_EQ(file, whole);
  FileAssembly done("f", whole.size());
  ASSERT_EQ(done.due(0).size(), 1u);
  EXPECT_TRUE(done.take(part_of({"f", whole.size()}, whole)));
  EXPECT_TRUE(done.whole());
}

TEST(FileParts, AFileThatGrowsIsAsLongAsItWasFirst) {
  FileAssembly assembly("f");
  EXPECT_TRUE(assembly.take({"f", 0, 4, "", "abcd"}));
  EXPECT_TRUE(assembly.take({"f", 4, 8, "", "efgh"}));
  EXPECT_TRUE(assembly.whole());
  EXPECT_EQ(assembly.total(), 4u);
}

TEST(FileParts, AFileThatCannotBeHadOrIsEmptyIsSoon) {
  FileAssembly none("f"), empty("f");
  EXPECT_FALSE(none.take({"f", 0, 0, "is not there", ""}));
  EXPECT_EQ(none.error(), "is not there");
  EXPECT_FALSE(empty.whole());
  EXPECT_TRUE(empty.take({"f", 0, 0, "", ""}));
  EXPECT_TRUE(empty.whole());
}

TEST(FileParts, ANameIsNoWayOutOfAFolder) {
  for (const char* good : {"robot.yaml", "a b", "x..y"}) EXPECT_TRUE(is_plain_name(good)) << good;
  for (const char* wrong : {"", ".", "..", "../x", "/etc/passwd", "a/b", ".key"})
    EXPECT_FALSE(is_plain_name(wrong)) << wrong;
  EXPECT_FALSE(is_plain_name(std::string_view("a\0b", 3)));
}

}  // namespace
}  // namespace sprung::gateway
