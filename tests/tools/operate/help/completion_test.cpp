#include "tools/operate/help/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "tests/support/own_folder.h"
#include "tests/tools/operate/help/sample_command.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

/// What bash itself offers for the last of these words.
class Completion : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "sprung_completion";
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "script") << bash_completion(test::SampleCommand().line.info(), {"cat", "dog"});
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::vector<std::string> offered(const std::string& words) const {
    const std::string command = "cd " + folder_.string() +
                                " && bash --norc -c 'source ./script; COMP_WORDS=(" + words +
                                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _leg; printf \"%s\\n\" " +
                                "\"${COMPREPLY[@]}\"'";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    char part[1024];
    while (std::fgets(part, sizeof part, pipe.get()) != nullptr) text += part;
    std::istringstream lines(text);
    std::vector<std::string> out;
    for (std::string line; std::getline(lines, line);) {
      if (!line.empty()) out.push_back(line);
    }
    return out;
  }
  std::filesystem::path folder_;
};

TEST_F(Completion, CommandsAreOffered) {
  EXPECT_THAT(offered("leg \"\""), IsSupersetOf({"jump", "can"}));
  EXPECT_THAT(offered("leg ju"), ElementsAre("jump"));
  EXPECT_THAT(offered("leg can \"\""), AllOf(Contains("dump"), Not(Contains("jump"))));
}

TEST_F(Completion, OptionsOfThatCommandAreOffered) {
  EXPECT_THAT(offered("leg jump --c"), UnorderedElementsAre("--count", "--clock"));
  EXPECT_THAT(offered("leg can dump --"), AllOf(Contains("--filter"), Not(Contains("--count"))));
}

TEST_F(Completion, ValuesThatAreAllowedAreOffered) {
  EXPECT_THAT(offered("leg jump --clock \"\""), ElementsAre("realtime", "lockstep"));
  EXPECT_THAT(offered("leg jump cat --clock l"), ElementsAre("lockstep"));
}

TEST_F(Completion, RobotsAreOfferedByName) { EXPECT_THAT(offered("leg jump d"), ElementsAre("dog")); }

TEST_F(Completion, OtherValuesAreFiles) {
  EXPECT_THAT(offered("leg can dump --filter scr"), ElementsAre("script"));
}

TEST(NamesOfOption, ShortAndLong) {
  OptionInfo option;
  option.name = "-c,--count";
  EXPECT_THAT(names_of(option), ElementsAre("-c", "--count"));
  EXPECT_EQ(long_name(option), "--count");
}

}  // namespace
}  // namespace sprung
