#include "runtime/host_lock.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

namespace sprung {
namespace {

using ::testing::HasSubstr;

std::string unique_name(const char* what) { return std::string("test/") + what + std::to_string(getpid()); }

std::string refusal(const std::string& name) {
  try {
    const HostLock lock(name, "bus leg (udp:1)");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(HostLock, SecondHolderIsRefusedAndToldWhoHasIt) {
  const HostLock first(unique_name("a"), "bus leg (udp:1)");
  const std::string said = refusal(unique_name("a"));
  EXPECT_THAT(said, HasSubstr("bus leg (udp:1) is in use by another process on this machine (" +
                              std::to_string(getpid()) + ")"));
  EXPECT_EQ(refusal(unique_name("b")), "") << "another name is free";
}

TEST(HostLock, NameIsFreeAgainWhenTheHolderIsGone) {
  { const HostLock first(unique_name("a"), "bus"); }
  EXPECT_EQ(refusal(unique_name("a")), "");
}

TEST(HostLock, MovedLockHoldsOn) {
  HostLock first(unique_name("a"), "bus");
  const HostLock second(std::move(first));
  EXPECT_NE(refusal(unique_name("a")), "");
}

}  // namespace
}  // namespace sprung
