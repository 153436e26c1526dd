#include "tools/station/gateway/via_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "runtime/command_line.h"
#include "tests/support/refusal.h"
#include "tools/station/gateway/udp_socket_shell.h"

namespace sprung::gateway {
namespace {

using testing::HasSubstr;

Via via(std::vector<const char*> words) {
  words.insert(words.begin(), "sprung");
  return take_via(static_cast<int>(words.size()), words.data());
}

std::string complaint(const std::vector<const char*>& words) {
  return test::refusal_of<WrongUse>([&] { (void)via(words); });
}

std::vector<std::string> texts(const Via& in) { return {in.words.begin(), in.words.end()}; }

TEST(ViaTest, StandsBeforeTheCommandAndIsTakenOffIt) {
  const Via there = via({"--via", "robot:7000", "--key", "k", "--encrypt", "walk", "--via-point", "3"});
  EXPECT_EQ(there.host, "robot:7000");
  EXPECT_EQ(there.key, "k");
  EXPECT_TRUE(there.hidden);
  EXPECT_THAT(texts(there), testing::ElementsAre("sprung", "walk", "--via-point", "3"));
  EXPECT_FALSE(there.emergency);
  EXPECT_TRUE(via({"--via", "robot", "estop"}).emergency);
  EXPECT_TRUE(via({"--via", "robot", "fetch", "--newest", "1"}).files_alone);
  EXPECT_FALSE(there.files_alone);
  const Via here = via({"stand"});
  EXPECT_EQ(here.host, "");
  EXPECT_THAT(texts(here), testing::ElementsAre("sprung", "stand"));
  EXPECT_THAT(texts(via({"--version"})), testing::ElementsAre("sprung", "--version"));
}

TEST(ViaTest, WithoutAKeyItIsTheUsualOne) {
  setenv("SPRUNG_OPERATOR_KEY", "/somewhere/else.key", 1);
  EXPECT_EQ(via({"--via", "robot", "status"}).key, "/somewhere/else.key");
  unsetenv("SPRUNG_OPERATOR_KEY");
  EXPECT_THAT(via({"--via", "robot", "status"}).key, HasSubstr(".config/sprung/operator.key"));
}

TEST(ViaTest, WhatBelongsToTheRobotsOwnComputerIsRefused) {
  for (const char* command : {"up", "down", "fault", "replay", "experiment", "drive", "can", "run"})
    EXPECT_THAT(complaint({"--via", "robot", command}), HasSubstr("of the robot's own computer")) << command;
  EXPECT_THAT(complaint({"--via"}), HasSubstr("--via needs a value"));
  EXPECT_THAT(complaint({"--via", "robot"}), HasSubstr("before a command"));
  EXPECT_THAT(complaint({"--key", "k", "stand"}), HasSubstr("go with --via"));
}

TEST(ViaTest, HelpNeedsNoRobot) { EXPECT_EQ(via({"--via", "robot", "up", "--help"}).host, ""); }

TEST(HostPortTest, IsReadWithAndWithoutAPort) {
  const auto read = [](const char* text) {
    const HostPort out = parse_host_port(text, 7447);
    return out.host + " " + std::to_string(out.port);
  };
  EXPECT_EQ(read("robot"), "robot 7447");
  EXPECT_EQ(read("10.0.0.1:5"), "10.0.0.1 5");
  EXPECT_EQ(read("::1"), "::1 7447");
  EXPECT_EQ(read("[::1]:5"), "::1 5");
  for (const char* wrong : {"", ":5", "robot:x", "robot:99999", "robot:123456"})
    EXPECT_THROW((void)parse_host_port(wrong, 7447), std::runtime_error) << wrong;
}

TEST(UdpSocketTest, WhatIsSentToOneArrivesWithItsSendersAddressAndIsAnswered) {
  UdpSocket robot = UdpSocket::bound_to({"127.0.0.1", 0});
  UdpSocket there = UdpSocket::connected_to({"127.0.0.1", robot.port()});
  there.send("hello");
  std::string from, nobody;
  ASSERT_TRUE(robot.wait(2000));
  const auto packet = robot.receive(from);
  ASSERT_TRUE(packet);
  EXPECT_EQ(*packet, "hello");
  EXPECT_EQ(address_text(from), "127.0.0.1:" + std::to_string(there.port()));
  EXPECT_FALSE(robot.receive(nobody));
  robot.send(std::string(50'000, 'x'), from);
  ASSERT_TRUE(there.wait(2000));
  EXPECT_EQ(there.receive(nobody)->size(), 50'000u);
}

TEST(UdpSocketTest, APortThatIsTakenIsNamed) {
  UdpSocket robot = UdpSocket::bound_to({"127.0.0.1", 0});
  EXPECT_THAT(test::refusal_of<std::runtime_error>([&] {
                UdpSocket::bound_to({"127.0.0.1", robot.port()});
              }),
              HasSubstr("cannot be had"));
}

}  // namespace
}  // namespace sprung::gateway
