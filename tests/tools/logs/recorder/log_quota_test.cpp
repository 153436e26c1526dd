#include "tools/logs/recorder/log_quota.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

class LogQuota : public testing::Test {
 protected:
  LogQuota() {
    for (const char* name : {"c.lcm", "a.lcm", "b.lcm"}) write(name, 1000);
    write("a.txt", 10);
    write("notes.md", 5000);
  }
  /// Each a minute younger than the one before.
  void write(const std::string& name, std::size_t bytes) {
    std::ofstream(folder_ / name) << std::string(bytes, 'x');
    fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() - std::chrono::hours(1) +
                                            std::chrono::minutes(minutes_++));
  }
  std::vector<std::string> removed(std::uint64_t most_bytes, const std::string& in_use) {
    std::vector<std::string> out;
    for (const std::string& path : remove_oldest_logs(folder_.path(), most_bytes, folder_ / in_use))
      out.push_back(fs::path(path).filename());
    return out;
  }
  bool there(const std::string& name) const { return fs::exists(folder_ / name); }

  test::OwnFolder folder_{"quota"};
  int minutes_ = 0;
};

TEST_F(LogQuota, TheOldestGoFirstUntilTheRestFits) {
  EXPECT_THAT(removed(3000, "b.lcm"), IsEmpty());
  EXPECT_THAT(removed(2000, "b.lcm"), ElementsAre("c.lcm"));
  EXPECT_THAT(removed(1999, "b.lcm"), ElementsAre("a.lcm"));
  EXPECT_FALSE(there("a.txt")) << "what was said beside it";
  EXPECT_TRUE(there("notes.md")) << "no log";
}

TEST_F(LogQuota, TheOneThatIsWrittenStays) {
  EXPECT_THAT(removed(0, "c.lcm"), ElementsAre("a.lcm", "b.lcm"));
  EXPECT_TRUE(there("c.lcm"));
}

TEST_F(LogQuota, ALinkToALogElsewhereIsNone) {
  fs::create_symlink(folder_ / "notes.md", folder_ / "0.lcm");
  removed(0, "b.lcm");
  EXPECT_TRUE(there("notes.md"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "0.lcm"));
}

TEST_F(LogQuota, AFolderThatIsNotThereHasNone) {
  EXPECT_THAT(remove_oldest_logs(folder_ / "none", 0, ""), IsEmpty());
}

}  // namespace
}  // namespace sprung
