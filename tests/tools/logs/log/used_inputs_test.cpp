#include "tools/logs/log/used_inputs.h"

#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

std::string command_bytes() {
  auto message = stamped<sprung_msgs::drive_command_t>(12);
  message.n = 2;
  message.actuators.resize(2);
  message.used_joint_state_seq = 11;
  message.used_leg_command_seq = -1;
  return encoded(message);
}

std::optional<UsedInputs> read(const std::string& bytes) {
  return used_inputs(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

TEST(UsedInputs, AreReadFromADriveCommandOfAnySize) {
  const auto used = read(command_bytes());
  ASSERT_TRUE(used);
  EXPECT_EQ(used->seq, 12);
  EXPECT_EQ(used->joint_state_seq, 11);
  EXPECT_EQ(used->leg_command_seq, -1);
}

TEST(UsedInputs, OfAnotherTypeOrTooShortAreNone) {
  std::string other = command_bytes();
  other[0] = static_cast<char>(other[0] ^ 1);
  EXPECT_FALSE(read(other));
  EXPECT_FALSE(read(command_bytes().substr(0, 63)));
  EXPECT_FALSE(read(""));
}

}  // namespace
}  // namespace sprung::log
