/// `sprung experiment drop` as a command: files, exit status, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class ExperimentDrop : public SystemTest {};

TEST_F(ExperimentDrop, WritesPageAndRowsAndEndsAsItsRowsDo) {
  const std::string out = (folder_ / "out").string();
  const CommandResult result = sprung("experiment drop --seed 4 --seeds 1 --json --out " + out +
                                      " 2>/dev/null");
  const nlohmann::json printed = nlohmann::json::parse(result.output);
  EXPECT_EQ(printed, nlohmann::json::parse(std::ifstream(out + "/drop.json")));
  bool all_ok = true;
  for (const nlohmann::json& row : printed["rows"]) all_ok = all_ok && row["ok"].get<bool>();
  EXPECT_EQ(result.status, all_ok ? 0 : 1);
  EXPECT_EQ(printed["seed"], 4);
  EXPECT_EQ(printed["preset"], "best");
  EXPECT_GT(printed["simulated_s"], 22 * 2.0);  // 20 landings, one of each law
  std::ifstream page(out + "/drop.html");
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_THAT(html, HasSubstr("sprung experiment drop --robot single_leg --preset best --seed 4 --seeds 1"));
}

TEST_F(ExperimentDrop, WhatCannotBeDoneIsRefusedWithTheReason) {
  for (const char* seeds : {"0", "-3"}) {
    const CommandResult none = sprung(std::string("experiment drop --seeds ") + seeds);
    EXPECT_EQ(none.status, 1) << seeds;
    EXPECT_THAT(none.output, HasSubstr("--seeds must be 1 or more")) << seeds;
  }
  const CommandResult axis = sprung("experiment drop --robot test_axis");
  EXPECT_EQ(axis.status, 1);
  EXPECT_THAT(axis.output, HasSubstr("no joint 'hip'"));
  EXPECT_THAT(sprung("experiment drop --preset worst").output, HasSubstr("paper, best"));
  EXPECT_THAT(sprung("experiment drop --plant no_such_value=1").output, HasSubstr("friction_scale"));
  EXPECT_EQ(sprung("experiment drop --hight 3").status, 2);
  EXPECT_THAT(sprung("experiment drop --help").output, HasSubstr("xample"));
}

}  // namespace
}  // namespace sprung
