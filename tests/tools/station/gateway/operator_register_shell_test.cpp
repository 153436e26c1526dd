#include "tools/station/gateway/operator_register_shell.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/station/gateway/gateway_sample.h"

namespace sprung::gateway {
namespace {

using testing::HasSubstr;

class OperatorRegister : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() / name; }
  template <class Call>
  static std::string refusal(Call call) {
    return test::refusal_of<std::runtime_error>(call);
  }
  test::OwnFolder folder_{"gateway"};
};

TEST_F(OperatorRegister, IsReadAsItWasWrittenAndNobodyElseCanWriteIt) {
  const std::vector<KnownOperator> written{
      {"alice", key_of_number(1).public_key(), Role::kDrive, "2026-11-27T10:00:00", ""},
      {"bob", key_of_number(2).public_key(), Role::kMaintain, "2026-11-27T10:00:00", "2026-11-28T10:00:00"}};
  write_register(path("operators.json"), written);
  struct stat found {};
  ASSERT_EQ(stat(path("operators.json").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600u);
  const auto read = read_register(path("operators.json"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].name, "alice");
  EXPECT_EQ(read[0].key, written[0].key);
  EXPECT_EQ(read[1].role, Role::kMaintain);
  EXPECT_EQ(read[1].revoked, written[1].revoked);
  EXPECT_EQ(register_text(read), register_text(written));
}

TEST_F(OperatorRegister, WhoWritesItKeepsOthersFromIt) {
  const std::string file = path("sub/operators.json");
  const auto is_free = [&] {
    const OpenFile other(open((file + ".lock").c_str(), O_RDWR));
    return flock(other.fd, LOCK_EX | LOCK_NB) == 0;
  };
  {
    const RegisterLock lock(file);
    EXPECT_FALSE(is_free());
  }
  EXPECT_TRUE(is_free());
}

TEST_F(OperatorRegister, NoneIsEmptyAndOneThatOthersMayWriteIsRefused) {
  EXPECT_TRUE(read_register(path("none.json")).empty());
  write_register(path("operators.json"), {});
  chmod(path("operators.json").c_str(), 0666);
  EXPECT_THAT(refusal([&] { (void)read_register(path("operators.json")); }), HasSubstr("chmod 600"));
}

TEST_F(OperatorRegister, WhatIsMalformedNamesFileAndRemedy) {
  EXPECT_THAT(refusal([] { (void)parse_register("{", "x.json"); }), HasSubstr("x.json: is no register"));
  EXPECT_THAT(refusal([] { (void)parse_register(R"({"operators":[{"name":"a"}]})", "x.json"); }),
              HasSubstr("sprung operator key new"));
  const std::string key = to_hex(key_of_number(1).public_key());
  const auto with = [&](const std::string& k, const std::string& role) {
    return R"({"operators":[{"name":"a","key":")" + k + R"(","role":")" + role +
           R"(","made":"","revoked":""}]})";
  };
  EXPECT_THAT(refusal([&] { (void)parse_register(with(key, "king"), "x.json"); }), HasSubstr("role of a"));
  EXPECT_THAT(refusal([&] { (void)parse_register(with("12", "drive"), "x.json"); }),
              HasSubstr("key is no key"));
}

TEST_F(OperatorRegister, TheRobotsKeyStaysTheSameAndIsItsOwnersAlone) {
  start_crypto();
  const PublicKey made = robot_key(folder_.path()).public_key();
  EXPECT_EQ(robot_key(folder_.path()).public_key(), made);
  chmod(path("gateway.key").c_str(), 0644);
  EXPECT_THAT(refusal([&] { (void)robot_key(folder_.path()); }), HasSubstr("chmod 600"));
  chmod(path("gateway.key").c_str(), 0600);
  std::ofstream(path("gateway.key")) << "x\n";
  EXPECT_THAT(refusal([&] { (void)robot_key(folder_.path()); }), HasSubstr("does not hold 32 bytes"));
}

TEST_F(OperatorRegister, AnOperatorsKeyIsReadBackAndNotWrittenOver) {
  const OperatorKeyFile key{"alice", "leg", key_of_number(1).seed(), key_of_number(9).public_key()};
  write_operator_key(path("alice.key"), key);
  const OperatorKeyFile read = read_operator_key(path("alice.key"));
  EXPECT_EQ(read.name, "alice");
  EXPECT_EQ(read.seed, key.seed);
  EXPECT_EQ(read.robot_key, key.robot_key);
  EXPECT_THAT(refusal([&] { write_operator_key(path("alice.key"), key); }), HasSubstr("is there already"));
  EXPECT_THAT(refusal([&] { (void)read_operator_key(path("none.key")); }), HasSubstr("operator key new"));
  chmod(path("alice.key").c_str(), 0640);
  EXPECT_THAT(refusal([&] { (void)read_operator_key(path("alice.key")); }), HasSubstr("chmod 600"));
}

}  // namespace
}  // namespace sprung::gateway
