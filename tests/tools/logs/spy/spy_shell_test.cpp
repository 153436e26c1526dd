/// sprung spy under a pseudo terminal: keys in, a screen out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"
#include "tests/tools/logs/spy/network_sender.h"
#include "tests/tools/logs/spy/pseudo_terminal.h"

namespace sprung {
namespace {

class SpyTerminalTest : public testing::Test {
 protected:
  std::vector<std::string> spy(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{test::bin_dir() + "/sprung", "spy", "--url", sender_.url()};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  test::NetworkSender sender_;
};

TEST_F(SpyTerminalTest, KeysLeadFromChannelsToFieldsToAPlotAndOut) {
  test::PseudoTerminal terminal(spy());
  ASSERT_TRUE(terminal.sees("JOINT_STATE       joint_state_t")) << terminal.screen();
  ASSERT_TRUE(terminal.sees("MOTION_STATE      motion_state_t")) << terminal.screen();
  terminal.press("\r");
  ASSERT_TRUE(terminal.sees("joints[0].gear_output_torque_Nm")) << terminal.screen();
  ASSERT_TRUE(terminal.sees("500 Nm")) << terminal.screen();
  terminal.press("/[1].gear_output_torque_Nm\r");
  ASSERT_TRUE(terminal.sees("[only '[1].gear_output_torque_Nm']")) << terminal.screen();
  ASSERT_TRUE(terminal.sees("▁")) << terminal.screen();
  terminal.press("\r");
  ASSERT_TRUE(terminal.sees("last 10 s")) << terminal.screen();
  // A Braille letter with dots, whichever: U+2840 to U+28BF begin so.
  ASSERT_TRUE(terminal.sees("\xE2\xA2", 5.0) || terminal.sees("\xE2\xA1", 5.0)) << terminal.screen();
  terminal.press("\x1b");
  ASSERT_TRUE(terminal.sees("[only")) << terminal.screen();
  terminal.press("q");
  EXPECT_EQ(terminal.ends(), 0);
}

TEST_F(SpyTerminalTest, ArrowsMoveAndAChannelCanBeNamed) {
  test::PseudoTerminal terminal(spy({"MOTION_STATE"}));
  ASSERT_TRUE(terminal.sees("state_name")) << terminal.screen();
  ASSERT_TRUE(terminal.sees("thrust")) << terminal.screen();
  terminal.press(
      "\x1b"
      "D");  // left
  ASSERT_TRUE(terminal.sees("JOINT_STATE       joint_state_t")) << terminal.screen();
  terminal.press(
      "\x1b"
      "B\r");  // down
  ASSERT_TRUE(terminal.sees("legs[0].phase_time_s")) << terminal.screen();
  terminal.press("\x03");  // Ctrl-C
  EXPECT_EQ(terminal.ends(), 0);
}

}  // namespace
}  // namespace sprung
