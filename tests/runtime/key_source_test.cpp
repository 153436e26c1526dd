#include "runtime/key_source.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/own_folder.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class KeySource : public testing::Test {
 protected:
  void write(const std::string& bytes, mode_t mode) const {
    std::ofstream(path_) << bytes;
    ASSERT_EQ(chmod(path_.c_str(), mode), 0);
  }
  static auto refuses(const char* why) { return ThrowsMessage<std::runtime_error>(HasSubstr(why)); }

  const test::OwnFolder own_folder_{"key"};
  const std::string path_ = (own_folder_.path() / "run.key").string();
};

TEST_F(KeySource, EveryKeyIsAnother) { EXPECT_NE(random_key()->bytes(), random_key()->bytes()); }

TEST_F(KeySource, FileIsItsOwnersAlone) {
  const auto key = random_key();
  umask(0);
  write_key_file(path_, *key);
  umask(022);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_key_file(path_)->bytes(), key->bytes());
}

TEST_F(KeySource, NewKeyTakesThePlaceOfAnOldOneAndFollowsNoLink) {
  const std::string elsewhere = (own_folder_.path() / "elsewhere").string();
  fs::create_symlink(elsewhere, path_);
  write_key_file(path_, *random_key());
  EXPECT_FALSE(fs::exists(elsewhere));
  const auto key = random_key();
  write_key_file(path_, *key);
  EXPECT_EQ(read_key_file(path_)->bytes(), key->bytes());
}

TEST_F(KeySource, FileThatOthersMayReadIsRefusedWithTheRemedy) {
  write(std::string(32, 'k'), 0644);
  EXPECT_THAT([&] { read_key_file(path_); }, refuses("chmod 600"));
  ASSERT_EQ(chmod(path_.c_str(), 0600), 0);
  EXPECT_NO_THROW(read_key_file(path_));
}

TEST_F(KeySource, FileThatIsNoKeyIsRefused) {
  EXPECT_THAT([&] { read_key_file(path_); }, refuses("cannot be read"));
  for (const std::size_t size : {0U, 31U, 33U, 4096U}) {
    write(std::string(size, 'k'), 0600);
    EXPECT_THAT([&] { read_key_file(path_); }, refuses("32 bytes")) << size;
  }
  fs::remove(path_);
  fs::create_symlink("/dev/zero", path_);
  EXPECT_THAT([&] { read_key_file(path_); }, refuses("it is a link"));
  fs::remove(path_);
  fs::create_directory(path_);
  EXPECT_THAT([&] { read_key_file(path_); }, refuses("it is no file"));
}

TEST_F(KeySource, EveryProcessCanReadTheSameDescriptor) {
  const auto key = random_key();
  const KeyFd fd(*key);
  for (int process = 0; process < 3; ++process)
    EXPECT_EQ(read_key_fd(dup(fd.number()))->bytes(), key->bytes()) << "of one that shares its offset";
}

TEST_F(KeySource, DescriptorIsReadFromItsBegin) {
  const auto key = random_key();
  const KeyFd fd(*key);
  std::array<std::uint8_t, 64> bytes{};
  ASSERT_EQ(::read(fd.number(), bytes.data(), bytes.size()), static_cast<ssize_t>(kKeyBytes));
  EXPECT_TRUE(std::equal(key->bytes().begin(), key->bytes().end(), bytes.begin()));
}

TEST_F(KeySource, DescriptorIsClosedWhenReadAndInOtherPrograms) {
  const KeyFd fd(*random_key());
  EXPECT_EQ(fcntl(fd.number(), F_GETFD), FD_CLOEXEC);
  const int copy = dup(fd.number());
  (void)read_key_fd(copy);
  EXPECT_EQ(fcntl(copy, F_GETFD), -1);
  KeyFd::inherit(fd.number());
  EXPECT_EQ(fcntl(fd.number(), F_GETFD), 0);
}

TEST_F(KeySource, NobodyChangesTheDescriptor) {
  const auto key = random_key();
  const KeyFd fd(*key);
  EXPECT_LT(pwrite(fd.number(), "x", 1, 0), 0);
  EXPECT_LT(ftruncate(fd.number(), 0), 0);
  EXPECT_EQ(read_key_fd(dup(fd.number()))->bytes(), key->bytes());
}

TEST_F(KeySource, PipeDoesToo) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "0123456789abcdef0123456789abcdef", 32), 32);
  close(ends[1]);
  EXPECT_EQ(read_key_fd(ends[0])->bytes()[10], 'a');
}

TEST_F(KeySource, DescriptorWithoutAKeyIsRefused) {
  EXPECT_THAT([] { read_key_fd(999); }, refuses("sprung run"));
  write(std::string(31, 'k'), 0600);
  EXPECT_THAT([&] { read_key_fd(open(path_.c_str(), O_RDONLY)); }, refuses("holds no key"));
}

}  // namespace
}  // namespace sprung
