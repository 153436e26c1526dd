#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/lab/jump/live_jump_report.h"

namespace sprung {
namespace {

TEST(JumpTable, OneLineAJumpWithBothTorqueSignals) {
  JumpResult jump;
  jump.height_mm = 211.71;
  jump.touchdown_time_ms = 556.0;
  jump.peak_knee_torque_Nm = 174.4;
  jump.peak_knee_output_torque_Nm = 38.4;
  jump.upright = true;
  const std::string text = jump_table({jump, JumpResult{}});
  EXPECT_THAT(text, testing::HasSubstr("   1    211.7     556.0"));
  EXPECT_THAT(text, testing::HasSubstr("174.4    38.4"));
  EXPECT_THAT(text, testing::HasSubstr("  yes\n"));
  EXPECT_THAT(text, testing::HasSubstr("   2        -"));
  EXPECT_THAT(text, testing::HasSubstr("  NO\n"));
}

}  // namespace
}  // namespace sprung
