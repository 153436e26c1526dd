#include "tools/logs/incident/log_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/tools/logs/log/log_sample.h"

namespace sprung::log {
namespace {

using testing::ElementsAre;

class LogChoice : public testing::Test {
 protected:
  std::string file(const std::string& name) {
    put_bytes(folder_(name), "x");
    return folder_(name);
  }
  LogFolder folder_;
};

TEST_F(LogChoice, TheLogThatWasWrittenLastIsTheNewest) {
  const std::string old = file("b.lcm"), newest = file("a.lcm");
  file("c.txt");
  std::filesystem::last_write_time(old, std::filesystem::last_write_time(newest) - std::chrono::hours(1));
  EXPECT_EQ(newest_log({folder_("not there"), folder_.path.string()}), newest);
  EXPECT_EQ(newest_log({folder_("not there")}), "");
}

TEST_F(LogChoice, PartsOfARecordingAreFoundAndNoOthers) {
  const std::string first = file("leg-20261123-105147-000.lcm"), second = file("leg-20261123-105147-001.lcm");
  const std::string third = file("leg-20261123-105147-002.lcm");
  file("leg-20261123-105147-004.lcm");
  EXPECT_EQ(newest_part(first), third);
  EXPECT_THAT(parts_back_from(second), ElementsAre(second, first));
  const std::string whole = file("leg-20261123-105148.lcm");
  file("leg-20261123-105147.lcm");
  file("leg-20261123-105149.lcm");
  EXPECT_EQ(newest_part(whole), whole) << "a time of day is no number of a part";
  EXPECT_THAT(parts_back_from(whole), ElementsAre(whole));
}

TEST_F(LogChoice, LinesStandBesideTheFirstLogOfARun) {
  const std::string lines = file("leg-20261123-105147.txt");
  for (const char* log : {"leg-20261123-105147.lcm", "leg-20261123-105147-003.lcm",
                          "leg-20261123-105147-2.lcm", "leg-20261123-105147-2-003.lcm"})
    EXPECT_EQ(lines_beside(folder_(log)), lines) << log;
  EXPECT_EQ(lines_beside(folder_("leg-20261123-105148.lcm")), "");
  EXPECT_EQ(lines_beside(folder_("leg.lcm")), "");
}

}  // namespace
}  // namespace sprung::log
