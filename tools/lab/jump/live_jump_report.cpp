#include "tools/lab/jump/live_jump_report.h"

#include <sprung_version.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/lab/jump/jump_report.h"

namespace sprung {

namespace {

using report::Cell;
using report::Mark;

std::vector<Cell> cells(std::size_t number, const JumpResult& jump) {
  return {number,
          jump.height_mm,
          jump.touchdown_time_ms,
          jump.peak_knee_torque_Nm,
          jump.peak_knee_output_torque_Nm,
          jump.landing_knee_torque_Nm,
          jump.landing_knee_output_torque_Nm,
          jump.upright ? Cell("yes", Mark::kGood) : Cell("no", Mark::kBad)};
}

report::Table table_of(const std::vector<JumpResult>& jumps) {
  report::Table table{"Each jump",
                      {"jump", "height (mm)", "touchdown after (ms)", "knee in the push-off, motor side (Nm)",
                       "knee in the push-off, gear output (Nm)", "knee in the landing, motor side (Nm)",
                       "knee in the landing, gear output (Nm)", "landed upright"}};
  for (std::size_t i = 0; i < jumps.size(); ++i) table.rows.push_back(cells(i + 1, jumps[i]));
  table.note =
      "Height is the hip's rise above where it was when the foot left the floor. Motor side: gear ratio "
      "times motor torque less "
      "friction, the papers' signal. Gear output: what the link truly feels, from the simulation.";
  return table;
}

std::string narrow(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::isfinite(value) ? "%8.1f" : "       -", value);
  return text;
}

}  // namespace

report::Report live_jump_report(const LiveJumps& live) {
  if (live.jumps.empty()) throw std::invalid_argument("there is no jump to report");
  report::Report page{"Jumps of " + live.robot,
                      "preset " + live.preset + ", mode " + name(live.mode) +
                          ", simulated drives, sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH,
                      live.command};
  report::Section summary{
      "Summary",
      {"The leg stood, crouched, pushed off, flew and landed, " + std::to_string(live.jumps.size()) +
       " time(s), commanded from the command line; the first jump is drawn below."},
      {table_of(live.jumps)}};
  page.sections = {summary, jump_figure({live.preset, live.mode, live.jumps.front()}, live.samples)};
  return page;
}

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
