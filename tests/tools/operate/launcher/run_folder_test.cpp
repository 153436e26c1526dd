#include "tools/operate/launcher/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/own_folder.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class RunFolder : public testing::Test {
 protected:
  void expect_refused(const std::string& why, const std::string& remedy) const {
    const auto refused = ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(why), HasSubstr(remedy)));
    EXPECT_THAT([&] { require_private(folder_); }, refused);
    EXPECT_THAT([&] { make_private(folder_); }, refused);
  }
  const test::OwnFolder own_{"run-folder"};
  const std::filesystem::path folder_ = own_.path() / "sprung-1000";
};

TEST_F(RunFolder, IsMadeForItsUserAlone) {
  EXPECT_NO_THROW(require_private(folder_)) << "what is not there cannot lie";
  make_private(folder_);
  struct stat found {};
  ASSERT_EQ(stat(folder_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0700U);
  EXPECT_NO_THROW(make_private(folder_)) << "the next run finds it";
}

TEST_F(RunFolder, ALinkIsRefusedWhereverItLeads) {
  std::filesystem::create_directory(own_.path() / "mine");
  std::filesystem::create_directory_symlink(own_.path() / "mine", folder_);
  expect_refused("it is a link", "rm " + folder_.string());
}

TEST_F(RunFolder, AFileIsRefused) {
  std::ofstream(folder_) << "no folder";
  expect_refused("it is no folder", "rm " + folder_.string());
}

TEST_F(RunFolder, WhatGroupOrOthersMayWriteIsRefused) {
  make_private(folder_);
  for (const mode_t mode : {0770, 0707, 01777}) {
    ASSERT_EQ(chmod(folder_.c_str(), mode), 0);
    expect_refused("others may write into it", "chmod 700 " + folder_.string());
  }
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  EXPECT_NO_THROW(require_private(folder_)) << "to read it is no harm: earlier versions made it so";
}

TEST_F(RunFolder, AnotherUsersIsRefused) {
  const auto refused = [](const std::string& user) {
    return ThrowsMessage<std::runtime_error>(
        AllOf(HasSubstr("belongs to user " + user), HasSubstr("sudo rm -r")));
  };
  if (getuid() != 0) {
    EXPECT_THAT([] { require_private("/usr"); }, refused("0"));
    return;
  }
  make_private(folder_);
  ASSERT_EQ(chown(folder_.c_str(), 12345, 12345), 0);
  EXPECT_THAT([&] { require_private(folder_); }, refused("12345"));
}

TEST_F(RunFolder, OneThatWasChosenMayBeAServicesToRead) {
  make_private(folder_);
  ASSERT_EQ(chmod(folder_.c_str(), 0775), 0);
  setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
  EXPECT_FALSE(read_run_file("default"));
  EXPECT_EQ(made_run_folder(), folder_);
  unsetenv("SPRUNG_RUN_DIR");
}

}  // namespace
}  // namespace sprung
