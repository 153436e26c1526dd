#include "tools/station/gateway/served_files_shell.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

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

class ServedFilesTest : public testing::Test {
 protected:
  ServedFilesTest() {
    for (const char* name : {"robot.yaml", "a.lcm", "b.tar.gz", "key", ".hidden.lcm"})
      std::ofstream(folder_ / name) << name;
  }
  FilePart first(const std::string& file, std::int64_t now_us = 0) {
    return files_.parts({file, 0, 1}, now_us).front();
  }
  test::OwnFolder folder_{"served"};
  ServedFiles files_{""};
};

TEST_F(ServedFilesTest, OfARobotThatIsUpItsRunItsFilesAndItsLogs) {
  EXPECT_EQ(first("run").error, kNoRobot);
  EXPECT_NE(first("logs").error, "");
  files_.robot_is_up("what runs", folder_.path(), folder_ / "a.lcm");
  EXPECT_EQ(first("run").bytes, "what runs");
  EXPECT_EQ(first("robot/robot.yaml").bytes, "robot.yaml");
  const auto logs = nlohmann::json::parse(first("logs").bytes);
  ASSERT_EQ(logs.size(), 2u) << "neither keys nor hidden files";
  for (const auto& log : logs) EXPECT_EQ(log.at("size"), log.at("name").get<std::string>().size());
  EXPECT_EQ(first("log/b.tar.gz").bytes, "b.tar.gz");
}

TEST_F(ServedFilesTest, LogsStayToBeHadWhenTheRobotIsDown) {
  files_.robot_is_up("what runs", folder_.path(), folder_ / "a.lcm");
  files_.robot_is_down();
  EXPECT_EQ(first("run").error, kNoRobot);
  EXPECT_EQ(first("robot/robot.yaml").error, kNoRobot);
  EXPECT_EQ(first("log/a.lcm").bytes, "a.lcm");
}

TEST_F(ServedFilesTest, NothingElseOfTheComputerIsToBeHad) {
  files_.robot_is_up("what runs", folder_.path(), folder_ / "a.lcm");
  std::filesystem::create_symlink("/etc/passwd", folder_ / "link.lcm");
  for (const char* wrong : {"log/link.lcm", "log/key", "log/.hidden.lcm", "log/../a.lcm", "log//etc/passwd",
                            "key", "", "robot/../a.lcm", "robot/", "/etc/passwd", "log/robot.yaml"})
    EXPECT_NE(first(wrong).error, "") << wrong;
}

TEST_F(ServedFilesTest, SeveralPartsAtOnceEndWithTheFile) {
  std::ofstream(folder_ / "long.lcm") << std::string(3 * kPartBytes + 10, 'x');
  files_.robot_is_up("what runs", folder_.path(), folder_ / "a.lcm");
  EXPECT_EQ(files_.parts({"log/long.lcm", 0, kMostParts}, 0).size(), 4u);
  EXPECT_EQ(files_.parts({"log/long.lcm", kPartBytes, 2}, 0).size(), 2u);
  EXPECT_EQ(files_.parts({"log/none.lcm", 0, kMostParts}, 0).size(), 1u);
}

}  // namespace
}  // namespace sprung::gateway
