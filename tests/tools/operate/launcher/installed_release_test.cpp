#include "tools/operate/launcher/installed_release.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;

const std::string kOwn = "version: 0.2.0\nbuild: abc\nmessage_types: 0011\n";

TEST(InstalledRelease, SameReleaseIsNoTrouble) { EXPECT_EQ(why_not_of_release(kOwn, kOwn, "f"), ""); }

TEST(InstalledRelease, WhatDiffersIsNamedWithFileBothValuesAndARemedy) {
  EXPECT_THAT(why_not_of_release("version: 0.1.0\nbuild: abc\nmessage_types: 0011\n", kOwn, "/usr/release"),
              AllOf(HasSubstr("/usr/release has version 0.1.0, this program 0.2.0"), HasSubstr("reinstall")));
  EXPECT_THAT(why_not_of_release("version: 0.2.0\nbuild: abd\nmessage_types: 0011\n", kOwn, "f"),
              HasSubstr("build abd, this program abc"));
}

TEST(InstalledRelease, MessageTypesComeBeforeTheBuild) {
  EXPECT_THAT(why_not_of_release("version: 0.2.0\nbuild: abd\nmessage_types: 0012\n", kOwn, "f"),
              HasSubstr("message_types 0012, this program 0011"));
}

TEST(InstalledRelease, AFileThatIsCutShortIsTrouble) {
  EXPECT_THAT(why_not_of_release("version: 0.2.0\nbu", kOwn, "f"), HasSubstr("message_types nothing"));
}

TEST(InstalledRelease, SaysVersionBuildAndTypesOfThisProgram) {
  EXPECT_THAT(release_text(), MatchesRegex("version: [0-9]+\\.[0-9]+\\.[0-9]+\nbuild: [^\n]+\n"
                                           "message_types: [0-9a-f]{16}\n"));
}

TEST(InstalledRelease, IsReadBesideTheFolderOfThePrograms) {
  const test::OwnFolder folder("installed_release");
  const std::string programs = folder / "bin";
  const std::string release = folder / "share/sprung/release";
  EXPECT_NO_THROW(check_installed_release(programs)) << "a build folder has no such file";
  std::filesystem::create_directories(folder / "share/sprung");
  std::ofstream(release) << release_text();
  EXPECT_NO_THROW(check_installed_release(programs));
  std::ofstream(release) << "version: 0.0.1\n";
  EXPECT_THROW(check_installed_release(programs), std::runtime_error);
}

}  // namespace
}  // namespace sprung
