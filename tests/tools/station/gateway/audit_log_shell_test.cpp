#include "tools/station/gateway/audit_log_shell.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/own_folder.h"

namespace sprung::gateway {
namespace {

class AuditLogTest : public testing::Test {
 protected:
  std::vector<nlohmann::json> lines() const {
    std::vector<nlohmann::json> out;
    std::ifstream in(path_);
    for (std::string line; std::getline(in, line);) out.push_back(nlohmann::json::parse(line));
    return out;
  }
  test::OwnFolder folder_{"gateway"};
  std::string path_ = folder_.path() / "sub" / "audit.jsonl";
};

TEST_F(AuditLogTest, SaysWhoDidWhatFromWhereAndIsItsOwnersAlone) {
  AuditLog log(path_);
  log.event("alice", "10.0.0.2:5", "stand \"\n\xff");
  ASSERT_EQ(lines().size(), 1u);
  EXPECT_EQ(lines()[0]["who"], "alice");
  EXPECT_EQ(lines()[0]["from"], "10.0.0.2:5");
  struct stat found {};
  stat(path_.c_str(), &found);
  EXPECT_EQ(found.st_mode & 077, 0u);
}

TEST_F(AuditLogTest, AFloodIsALineASecondWithItsCount) {
  AuditLog log(path_);
  for (std::int64_t us = 0; us < 3'000'000; us += 1000) {
    log.turned("forged", "alice", "x", us);
    log.step(us);
  }
  log.step(0, true);
  std::int64_t count = 0;
  for (const auto& line : lines()) count += line["datagrams"].get<std::int64_t>();
  EXPECT_EQ(count, 3000);
  EXPECT_LE(lines().size(), 4u);
}

TEST_F(AuditLogTest, GoesOnWhereAnEarlierOneEnded) {
  AuditLog(path_).event("alice", "", "one");
  AuditLog(path_).event("alice", "", "two");
  EXPECT_EQ(lines().size(), 2u);
}

TEST_F(AuditLogTest, ALongOneMakesRoomForANewOne) {
  AuditLog log(path_);
  const std::string long_text(1'000'000, 'x');
  for (int k = 0; k < 12; ++k) log.event("alice", "", long_text);
  EXPECT_LT(lines().size(), 12u);
  EXPECT_TRUE(std::filesystem::exists(path_ + ".1"));
}

TEST_F(AuditLogTest, AFolderThatIsGoneEndsNothingAndOneThatCannotBeRefusesAtOnce) {
  AuditLog log(path_);
  const std::string long_text(AuditLog::kLongest, 'x');
  log.event("alice", "", long_text);
  std::filesystem::remove_all(std::filesystem::path(path_).parent_path());
  for (int k = 0; k < 3; ++k) log.event("alice", "", long_text);
  EXPECT_THROW(AuditLog{"/proc/none/audit.jsonl"}, std::runtime_error);
}

}  // namespace
}  // namespace sprung::gateway
