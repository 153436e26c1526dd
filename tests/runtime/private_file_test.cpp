#include "runtime/private_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class PrivateFile : public testing::Test {
 protected:
  template <class Call>
  static std::string refusal(Call call) {
    return test::refusal_of<std::runtime_error>(call);
  }
  std::string read(Others others) const { return read_private_file(path_, others); }
  mode_t mode() const {
    struct stat found {};
    stat(path_.c_str(), &found);
    return found.st_mode & 0777;
  }
  test::OwnFolder folder_{"private"};
  std::string path_ = folder_ / "sub/file";
};

TEST_F(PrivateFile, IsItsOwnersAloneAndReadAsItWasWritten) {
  const std::string text(10'000, 'x');
  write_private_file(path_, text);
  EXPECT_EQ(mode(), 0600u);
  EXPECT_EQ(read(Others::kMayNothing), text);
  write_private_file(path_, "shorter");
  EXPECT_EQ(read(Others::kMayNothing), "shorter");
}

TEST_F(PrivateFile, OneThatIsThereIsNotMadeAgain) {
  make_private_file(path_, "one");
  EXPECT_THAT(refusal([&] { make_private_file(path_, "two"); }), HasSubstr("is there already"));
  EXPECT_EQ(read(Others::kMayNothing), "one");
}

TEST_F(PrivateFile, WhatOthersMayDoIsNamedWithTheRemedy) {
  write_private_file(path_, "x");
  chmod(path_.c_str(), 0644);
  EXPECT_EQ(read(Others::kMayRead), "x");
  EXPECT_THAT(refusal([&] { (void)read(Others::kMayNothing); }), HasSubstr("chmod 600 " + path_));
  chmod(path_.c_str(), 0620);
  EXPECT_THAT(refusal([&] { (void)read(Others::kMayRead); }), HasSubstr("others may write it"));
}

TEST_F(PrivateFile, ALinkAndAFolderAreNoFiles) {
  EXPECT_THAT(refusal([&] { (void)read(Others::kMayRead); }), HasSubstr("cannot be read"));
  write_private_file(folder_ / "real", "x");
  std::filesystem::create_directories(folder_ / "sub");
  std::filesystem::create_symlink(folder_ / "real", path_);
  EXPECT_THAT(refusal([&] { (void)read(Others::kMayRead); }), HasSubstr("it is a link"));
  EXPECT_THAT(refusal([&] { (void)read_private_file(folder_.path(), Others::kMayRead); }),
              HasSubstr("it is no file"));
}

TEST(StateFolder, IsTheOneThatIsAskedForElseTheUsersOwn) {
  const char* const before = std::getenv("SPRUNG_STATE_DIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("SPRUNG_STATE_DIR", "/somewhere", 1);
  EXPECT_EQ(state_folder(), "/somewhere");
  unsetenv("SPRUNG_STATE_DIR");
  if (std::getenv("HOME") != nullptr) {
    EXPECT_THAT(state_folder(), HasSubstr(".local/state/sprung"));
  }
  if (before != nullptr) setenv("SPRUNG_STATE_DIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace sprung
