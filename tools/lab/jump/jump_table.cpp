#include "tools/lab/jump/jump_table.h"

#include <cmath>
#include <cstdio>

namespace sprung {

namespace {

std::string narrow(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::isfinite(value) ? "%8.1f" : "       -", value);
  return text;
}

}  // namespace

std::string jump_table(const std::vector<JumpResult>& jumps) {
  std::string text =
      "                            peak in the jump, Nm         landing, Nm\n"
      "jump   height touchdown     hip    knee    knee        knee    knee\n"
      "           mm        ms   motor   motor  output       motor  output  upright\n";
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const JumpResult& jump = jumps[i];
    text += (i < 9 ? "   " : "  ") + std::to_string(i + 1) + " " + narrow(jump.height_mm) + "  " +
            narrow(jump.touchdown_time_ms) + narrow(jump.peak_hip_torque_Nm) +
            narrow(jump.peak_knee_torque_Nm) + narrow(jump.peak_knee_output_torque_Nm) + "    " +
            narrow(jump.landing_knee_torque_Nm) + narrow(jump.landing_knee_output_torque_Nm) +
            (jump.upright ? "  yes" : "  NO") + "\n";
  }
  return text;
}

}  // namespace sprung
