/// Walks all subcommands of the program itself, whoever wrote them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace sprung {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

std::string output_of(const std::string& arguments) {
  const std::string command = "(" + test::bin_dir() + "/sprung " + arguments + ") 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char part[4096];
  while (std::fgets(part, sizeof part, pipe.get()) != nullptr) text += part;
  return text;
}

struct Found {
  std::string path;  ///< "can dump"
  Json command;
};

void collect(const Json& command, const std::string& path, std::vector<Found>& out) {
  for (const Json& sub : command["subcommands"]) {
    const std::string below = path.empty() ? sub["name"].get<std::string>()
                                           : path + " " + sub["name"].get<std::string>();
    out.push_back({below, sub});
    collect(sub, below, out);
  }
}

class EveryCommand : public testing::Test {
 protected:
  void SetUp() override {
    collect(Json::parse(output_of("man --json")), "", commands_);
    ASSERT_GT(commands_.size(), 30u);
  }
  std::vector<Found> commands_;
};

TEST_F(EveryCommand, HasAnExampleThatIsACallOfIt) {
  for (const Found& found : commands_) {
    const std::string example = found.command["example"];
    EXPECT_THAT(example, testing::AnyOf(HasSubstr("sprung " + found.path),
                                        HasSubstr("sprung --via robot " + found.path)))
        << "no example: sprung " << found.path;
  }
}

TEST_F(EveryCommand, ShowsItsExampleInHelp) {
  for (const Found& found : commands_)
    EXPECT_THAT(output_of(found.path + " --help"), HasSubstr(found.command["example"].get<std::string>()))
        << found.path;
}

TEST_F(EveryCommand, SaysWhatItIsForAndWhatEachOptionMeans) {
  for (const Found& found : commands_) {
    EXPECT_GT(found.command["description"].get<std::string>().size(), 8u) << found.path;
    for (const Json& option : found.command["options"])
      EXPECT_FALSE(option["help"].get<std::string>().empty()) << found.path << " " << option["name"];
  }
}

TEST_F(EveryCommand, WrongUseIsStatusTwoAndSaysWhereHelpIs) {
  for (const Found& found : commands_) {
    const std::string said = output_of(found.path + " --no-such-option; echo status $?");
    EXPECT_THAT(said, HasSubstr("status 2")) << found.path;
    EXPECT_THAT(said, HasSubstr("--help")) << found.path;
  }
}

}  // namespace
}  // namespace sprung
