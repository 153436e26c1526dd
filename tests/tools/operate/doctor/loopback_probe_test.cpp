#include <gtest/gtest.h>

#include "runtime/own_port.h"
#include "tools/operate/doctor/loopback_probe_shell.h"

namespace sprung::doctor {
namespace {

TEST(LoopbackProbe, MessagesComeBack) {
  const auto facts = probe_loopback("udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304", own_port(), 50);
  EXPECT_EQ(facts.error, "");
  EXPECT_EQ(facts.sent, 50);
  EXPECT_EQ(facts.received, 50);
}

TEST(LoopbackProbe, LcmThatCannotStartIsTold) {
  const auto facts = probe_loopback("nonsense://", 1, 5);
  EXPECT_NE(facts.error, "");
  EXPECT_EQ(facts.received, 0);
}

TEST(WithPort, ChangesThePortAlone) {
  EXPECT_EQ(with_port("udpm://239.255.76.67:7667?ttl=0", 123), "udpm://239.255.76.67:123?ttl=0");
  EXPECT_EQ(with_port("memq://", 123), "memq://");
}

}  // namespace
}  // namespace sprung::doctor
