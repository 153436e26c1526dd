#pragma once
/// What `sprung experiment jump` measured as rows: each mode beside S0's figures (facts A2), and the ratios
/// that issue and paper are about. Pure.
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/jump/jump_metrics.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// A number that every jump has.
struct JumpQuantity {
  const char* name;  ///< last part of the row's name
  const char* unit;
  double JumpResult::*value;
};
const std::vector<JumpQuantity>& jump_quantities();

/// One of S0's figures; none where it gives no number. @param quantity as in jump_quantities().
std::optional<double> paper_jump_figure(JumpMode mode, const std::string& quantity);

/// How many of S0's 18 figures (facts A2) a jump in each of its three modes meets within 10 %.
struct PaperScore {
  int within = 0;
  int figures = 0;
  std::vector<std::string> misses;  ///< "<mode>.<quantity>"
};

struct MeasuredJump {
  std::string preset;
  JumpMode mode;
  JumpResult result;
  double
      voltage_reserve = kNaN;  ///< least, from standing to standing (gait/voltage_reserve.h); NaN: not known
};

PaperScore score_against_paper(const std::vector<MeasuredJump>& jumps);

/// All rows. Jumps of `preset` in the papers' modes, and of preset `best` in mode adaptive and, beside it,
/// position. Demands stand at the rows of preset `paper` and of mode adaptive.
std::vector<ReportRow> jump_rows(const std::vector<MeasuredJump>& jumps, const std::string& preset);

/// nullptr where there is none.
const JumpResult* find_jump(const std::vector<MeasuredJump>& jumps, const std::string& preset, JumpMode mode);

}  // namespace sprung
