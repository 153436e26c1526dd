#include "tools/operate/help/man_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/tools/operate/help/sample_command.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string man_page_output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  std::string text;
  char part[4096];
  while (std::fgets(part, sizeof part, pipe.get()) != nullptr) text += part;
  return text;
}

TEST(RoffText, NothingIsTakenForACommand) {
  EXPECT_EQ(roff_text(".lcm files"), "\\&.lcm files");
  EXPECT_EQ(roff_text("'x'\n'y'"), "\\&'x'\n\\&'y'");
  EXPECT_EQ(roff_text("--count a\\b"), "\\-\\-count a\\eb");
}

TEST(ManPage, HasEveryCommandWithItsOptionsAndExample) {
  const std::string page = man_page(test::SampleCommand().line.info(), "1.0");
  EXPECT_THAT(page,
              AllOf(HasSubstr(".SS \"leg jump\""), HasSubstr(".SS \"leg can dump\""),
                    HasSubstr("\\-c, \\-\\-count"), HasSubstr("(default 1)"),
                    HasSubstr("one of realtime, lockstep"), HasSubstr("leg can dump \\-\\-filter emcy")));
}

/// groff complains about what it does not understand.
class Groff : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v groff >/dev/null") != 0)
      GTEST_SKIP() << "SKIPPED: groff is not installed (apt-get install groff-base)";
  }
};

TEST_F(Groff, TakesTheSampleWithoutAWarning) {
  const std::filesystem::path file = test::temp_dir() + "sprung_man";
  std::ofstream(file) << man_page(test::SampleCommand().line.info(), "1.0");
  EXPECT_EQ(man_page_output_of("groff -man -Tascii -ww -z " + file.string()), "");
  EXPECT_THAT(man_page_output_of("groff -man -Tascii -P-c " + file.string()),
              AllOf(HasSubstr("leg jump single_leg --count 3"), HasSubstr("A leg - and \\more.")));
  std::filesystem::remove(file);
}

TEST_F(Groff, TakesTheWholeManualWithoutAWarning) {
  EXPECT_GT(man_page_output_of(test::bin_dir() + "/sprung man").size(), 20'000u);
  EXPECT_EQ(man_page_output_of(test::bin_dir() + "/sprung man | groff -man -Tascii -ww -z"), "");
}

}  // namespace
}  // namespace sprung
