#include "tools/operate/help/command_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "runtime/command_info.h"
#include "tests/tools/operate/help/sample_command.h"

namespace sprung {
namespace {

using testing::ElementsAre;

const OptionInfo& option(const CommandInfo& command, const std::string& name) {
  for (const OptionInfo& one : command.options) {
    if (one.name == name) return one;
  }
  throw std::out_of_range(name);
}

TEST(CommandInfo, SaysWhatTheCommandTakes) {
  const test::SampleCommand sample;
  const CommandInfo info = sample.line.info();
  EXPECT_EQ(info.name, "leg");
  ASSERT_EQ(info.subcommands.size(), 2u);
  const CommandInfo& jump = info.subcommands[0];
  EXPECT_EQ(jump.description, "Jump on the spot.");
  EXPECT_TRUE(option(jump, "robot").positional);
  EXPECT_TRUE(option(jump, "robot").required);
  EXPECT_EQ(option(jump, "-c,--count").default_text, "1");
  EXPECT_FALSE(option(jump, "-c,--count").flag);
  EXPECT_THAT(option(jump, "--clock").allowed, ElementsAre("realtime", "lockstep"));
  EXPECT_TRUE(option(jump, "--forward").flag);
  EXPECT_TRUE(option(info.subcommands[1].subcommands[0], "--filter").repeated);
}

TEST(CommandInfo, ExampleIsTheCommandsOwnAndNotItsParents) {
  const test::SampleCommand sample;
  EXPECT_EQ(sample.line.info().example, "leg jump");
  EXPECT_EQ(sample.line.info().subcommands[1].example, "");
}

TEST(CommandJson, HoldsTheWholeTree) {
  const test::SampleCommand sample;
  const auto json = nlohmann::json::parse(command_json(sample.line.info()));
  EXPECT_EQ(json["subcommands"][1]["subcommands"][0]["example"], "leg can dump --filter emcy");
  EXPECT_EQ(json["subcommands"][0]["options"].size(), sample.line.info().subcommands[0].options.size());
}

}  // namespace
}  // namespace sprung
