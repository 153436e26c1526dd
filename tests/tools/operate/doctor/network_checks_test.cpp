#include "tools/operate/doctor/network_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::doctor {
namespace {

using testing::HasSubstr;

class NetworkChecks : public testing::Test {
 protected:
  NetworkChecks() {
    kernel_.receive_buffer_bytes = 4'194'304;
    kernel_.multicast_device = "lo";
    loopback_ = {"udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304", 200, 200, ""};
  }
  Check check(const std::string& name, const RobotConfig* robot = nullptr) const {
    for (const Check& one : network_checks(kernel_, loopback_, robot)) {
      if (one.name == name) return one;
    }
    throw std::out_of_range(name);
  }
  KernelFacts kernel_;
  LoopbackFacts loopback_;
};

TEST_F(NetworkChecks, HealthyMachinePassesEverything) {
  EXPECT_EQ(worst(network_checks(kernel_, loopback_, nullptr)), Verdict::kPass);
}

TEST_F(NetworkChecks, MissingRouteFailsWithTheCommandThatAddsIt) {
  kernel_.multicast_device = "";
  EXPECT_EQ(check("multicast route").verdict, Verdict::kFail);
  EXPECT_THAT(check("multicast route").remedy, HasSubstr("ip route add 239.0.0.0/8 dev lo"));
}

TEST_F(NetworkChecks, NothingComingBackFailsSomeLostWarns) {
  loopback_.received = 0;
  EXPECT_EQ(check("LCM loop-back").verdict, Verdict::kFail);
  EXPECT_THAT(check("LCM loop-back").remedy, HasSubstr("iptables"));
  loopback_.received = 199;
  EXPECT_EQ(check("LCM loop-back").verdict, Verdict::kWarn);
  EXPECT_THAT(check("LCM loop-back").found, HasSubstr("199 of 200"));
}

TEST_F(NetworkChecks, LcmThatDoesNotStartFailsWithItsOwnWords) {
  loopback_.error = "no route to host";
  EXPECT_EQ(check("LCM loop-back").verdict, Verdict::kFail);
  EXPECT_EQ(check("LCM loop-back").found, "no route to host");
}

TEST_F(NetworkChecks, TtlThatLeavesTheMachineWarns) {
  loopback_.url = "udpm://239.255.76.67:7667?ttl=1";
  EXPECT_EQ(check("ttl").verdict, Verdict::kWarn);
}

TEST_F(NetworkChecks, InterfaceThatLetsOthersInWarns) {
  loopback_.url = "udpm://239.255.76.67:7667?ttl=0&interface=eth0";
  EXPECT_EQ(check("ttl").verdict, Verdict::kWarn);
  EXPECT_THAT(check("ttl").found, HasSubstr("heard by the robot"));
}

TEST_F(NetworkChecks, AddressThatIsNoneIsNamed) {
  loopback_.url = "memq://";
  EXPECT_EQ(check("LCM address").verdict, Verdict::kFail);
  EXPECT_THAT(check("LCM address").found, HasSubstr("memq://"));
}

TEST_F(NetworkChecks, RobotOnSeveralHostsNeedsATtlAndAnInterface) {
  RobotConfig robot;
  robot.processes.resize(2);
  robot.processes[1].host = "trunk";
  EXPECT_EQ(check("ttl", &robot).verdict, Verdict::kFail);
  EXPECT_THAT(check("ttl", &robot).remedy, HasSubstr("ttl=1"));
  loopback_.url = "udpm://239.255.76.67:7667?ttl=1";
  EXPECT_EQ(check("ttl", &robot).verdict, Verdict::kFail);
  EXPECT_THAT(check("ttl", &robot).remedy, HasSubstr("interface="));
  loopback_.url += "&interface=eth0";
  EXPECT_EQ(check("ttl", &robot).verdict, Verdict::kPass);
}

TEST_F(NetworkChecks, SmallReceiveBufferWarnsWithTheSizeTheUrlAsksFor) {
  kernel_.receive_buffer_bytes = 212'992;
  EXPECT_EQ(check("receive buffer").verdict, Verdict::kWarn);
  EXPECT_THAT(check("receive buffer").remedy, HasSubstr("sysctl -w net.core.rmem_max=4194304"));
  loopback_.url = "udpm://239.255.76.67:7667?recv_buf_size=8388608";
  EXPECT_THAT(check("receive buffer").remedy, HasSubstr("8388608"));
}

}  // namespace
}  // namespace sprung::doctor
