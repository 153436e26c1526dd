#include "tools/lab/jump/jump_rows.h"

#include <algorithm>
#include <cmath>

namespace sprung {

namespace {

constexpr double kNear = 0.10;                   // issue 5: "within 10 %"
constexpr int kLeastWithin = 15;                 // of the 18
constexpr double kLeastHybridHeight_mm = 150.0;  // what this stack promises on its own plant
constexpr double kMostLandingOutput = 0.6;       // adaptive over position
/// [design choice] The papers' hybrid law spares the motors; the gears it may cost a twentieth at most.
constexpr double kMostPapersOutput = 1.05;
constexpr JumpMode kPapersModes[] = {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid};

struct PaperFigure {
  JumpMode mode;
  const char* quantity;
  double value;
};

/// Facts A2.
constexpr PaperFigure kPaper[] = {
    {JumpMode::kPosition, "height", 184.0},
    {JumpMode::kPosition, "touchdown_time", 550.0},
    {JumpMode::kPosition, "peak_hip_torque", 151.84},
    {JumpMode::kPosition, "peak_knee_torque", 162.72},
    {JumpMode::kPosition, "time_to_peak", 4.75},
    {JumpMode::kPosition, "y_lag", 32.0},
    {JumpMode::kPosition, "landing_knee_torque", 61.58},
    {JumpMode::kTorque, "height", 110.0},
    {JumpMode::kTorque, "touchdown_time", 460.0},
    {JumpMode::kTorque, "peak_hip_torque", 57.98},
    {JumpMode::kTorque, "peak_knee_torque", 107.84},
    {JumpMode::kTorque, "y_lag", 58.0},
    {JumpMode::kTorque, "landing_knee_torque", 24.21},
    {JumpMode::kHybrid, "height", 188.0},
    {JumpMode::kHybrid, "touchdown_time", 576.0},
    {JumpMode::kHybrid, "peak_hip_torque", 145.42},
    {JumpMode::kHybrid, "peak_knee_torque", 164.74},
    {JumpMode::kHybrid, "landing_knee_torque", 9.46},
};

const JumpQuantity& quantity_named(const std::string& wanted) {
  for (const JumpQuantity& quantity : jump_quantities()) {
    if (wanted == quantity.name) return quantity;
  }
  return jump_quantities().front();  // not reached: kPaper names only what there is
}

void demand(ReportRow& row, const std::string& preset, JumpMode mode) {
  if (row.name == "jump.hybrid.height") row.low = kLeastHybridHeight_mm;
  if (preset == "paper" && row.name == "jump.hybrid.landing_knee_torque") {
    row.low = (1.0 - kNear) * *paper_jump_figure(mode, "landing_knee_torque");
    row.high = (1.0 + kNear) * *paper_jump_figure(mode, "landing_knee_torque");
  }
}

void add_mode(const MeasuredJump& jump, std::vector<ReportRow>& rows) {
  for (const JumpQuantity& quantity : jump_quantities()) {
    rows.push_back(row(std::string("jump.") + name(jump.mode) + "." + quantity.name, quantity.unit,
                       jump.result.*quantity.value));
    rows.back().paper = paper_jump_figure(jump.mode, quantity.name);
    demand(rows.back(), jump.preset, jump.mode);
  }
  rows.push_back(row(std::string("jump.") + name(jump.mode) + ".upright", "", jump.result.upright ? 1 : 0));
  if (std::isfinite(jump.voltage_reserve))
    rows.push_back(
        row(std::string("jump.") + name(jump.mode) + ".voltage_reserve", "%", 100.0 * jump.voltage_reserve));
}

/// The landing's knee torque of one jump over another's, by the papers' signal and, beside it, truly at the
/// gear output.
void add_landing_ratio(const std::string& of, const JumpResult& ours, const JumpResult& other,
                       std::optional<double> paper, std::optional<double> high,
                       std::optional<double> high_output, std::vector<ReportRow>& rows) {
  rows.push_back(row("jump.ratio." + of, "", ours.landing_knee_torque_Nm / other.landing_knee_torque_Nm,
                     {{}, high, paper}));
  rows.push_back(row("jump.ratio." + of + "_output", "",
                     ours.landing_knee_output_torque_Nm / other.landing_knee_output_torque_Nm,
                     {{}, high_output, {}}));
}

double worst_landing_output_Nm(const JumpResult& jump) {
  return std::max(jump.landing_knee_output_torque_Nm, jump.landing_hip_output_torque_Nm);
}

/// What breaks a gear is at its output; the motors pay for it, as their side of the ratio shows.
void add_spared_gears(const JumpResult& adaptive, const JumpResult& position, std::vector<ReportRow>& rows) {
  add_landing_ratio("adaptive_over_position", adaptive, position, std::nullopt, std::nullopt,
                    kMostLandingOutput, rows);
  rows.push_back(row("jump.ratio.adaptive_over_position_worst_output", "",
                     worst_landing_output_Nm(adaptive) / worst_landing_output_Nm(position),
                     at_most(kMostLandingOutput)));
}

void add_hybrid_ratios(const JumpResult& hybrid, const JumpResult& position, const JumpResult& torque,
                       bool are_demanded, std::vector<ReportRow>& rows) {
  const auto bound = [&](double value) { return are_demanded ? std::optional<double>(value) : std::nullopt; };
  add_landing_ratio("hybrid_over_torque", hybrid, torque, 9.46 / 24.21, bound(1.0 / 2.0), std::nullopt, rows);
  add_landing_ratio("hybrid_over_position", hybrid, position, 9.46 / 61.58, bound(1.0 / 3.5),
                    bound(kMostPapersOutput), rows);
  rows.push_back(row("jump.ratio.height_hybrid_over_position", "", hybrid.height_mm / position.height_mm,
                     {bound(0.97), {}, 188.0 / 184.0}));
  rows.push_back(row("jump.ratio.work_hybrid_over_position", "",
                     hybrid.positive_work_J / position.positive_work_J,
                     demanded(are_demanded, between(0.95, 1.05))));
}

}  // namespace

const std::vector<JumpQuantity>& jump_quantities() {
  static const std::vector<JumpQuantity> kQuantities = {
      {"height", "mm", &JumpResult::height_mm},
      {"touchdown_time", "ms", &JumpResult::touchdown_time_ms},
      {"peak_knee_torque", "Nm", &JumpResult::peak_knee_torque_Nm},
      {"peak_hip_torque", "Nm", &JumpResult::peak_hip_torque_Nm},
      {"peak_knee_output_torque", "Nm", &JumpResult::peak_knee_output_torque_Nm},
      {"peak_hip_output_torque", "Nm", &JumpResult::peak_hip_output_torque_Nm},
      {"time_to_peak", "ms", &JumpResult::time_to_peak_ms},
      {"y_lag", "ms", &JumpResult::y_lag_ms},
      {"landing_knee_torque", "Nm", &JumpResult::landing_knee_torque_Nm},
      {"landing_knee_output_torque", "Nm", &JumpResult::landing_knee_output_torque_Nm},
      {"landing_hip_torque", "Nm", &JumpResult::landing_hip_torque_Nm},
      {"landing_hip_output_torque", "Nm", &JumpResult::landing_hip_output_torque_Nm},
      {"flight_knee_torque", "Nm", &JumpResult::flight_knee_torque_Nm},
      {"takeoff_time", "ms", &JumpResult::takeoff_time_ms},
      {"touchdown_leg", "mm", &JumpResult::touchdown_leg_mm},
      {"positive_work", "J", &JumpResult::positive_work_J},
  };
  return kQuantities;
}

std::optional<double> paper_jump_figure(JumpMode mode, const std::string& quantity) {
  for (const PaperFigure& figure : kPaper) {
    if (figure.mode == mode && quantity == figure.quantity) return figure.value;
  }
  return std::nullopt;
}

const JumpResult* find_jump(const std::vector<MeasuredJump>& jumps, const std::string& preset,
                            JumpMode mode) {
  for (const MeasuredJump& jump : jumps) {
    if (jump.preset == preset && jump.mode == mode) return &jump.result;
  }
  return nullptr;
}

PaperScore score_against_paper(const std::vector<MeasuredJump>& jumps) {
  PaperScore score;
  for (const PaperFigure& figure : kPaper) {
    const JumpResult* jump = find_jump(jumps, "paper", figure.mode);
    if (jump == nullptr) continue;
    ++score.figures;
    const double value = jump->*quantity_named(figure.quantity).value;
    if (std::abs(value / figure.value - 1.0) <= kNear) {
      ++score.within;
    } else {
      score.misses.push_back(std::string(name(figure.mode)) + "." + figure.quantity);
    }
  }
  return score;
}

std::vector<ReportRow> jump_rows(const std::vector<MeasuredJump>& jumps, const std::string& preset) {
  std::vector<ReportRow> rows;
  for (const MeasuredJump& jump : jumps) {
    const bool for_comparison = jump.preset != preset && jump.mode != JumpMode::kAdaptive;
    if (!for_comparison) add_mode(jump, rows);
  }
  const JumpResult* of[3];
  for (int i = 0; i < 3; ++i) of[i] = find_jump(jumps, preset, kPapersModes[i]);
  if (of[0] && of[1] && of[2]) add_hybrid_ratios(*of[2], *of[0], *of[1], preset == "paper", rows);
  const auto adaptive = std::find_if(
      jumps.begin(), jumps.end(), [](const MeasuredJump& jump) { return jump.mode == JumpMode::kAdaptive; });
  const JumpResult* firm = adaptive == jumps.end() ? nullptr
                                                   : find_jump(jumps, adaptive->preset, JumpMode::kPosition);
  if (firm) add_spared_gears(adaptive->result, *firm, rows);
  const PaperScore score = score_against_paper(jumps);
  if (score.figures > 0) {
    rows.push_back(row("jump.paper.within_10_percent", "", score.within, {kLeastWithin, {}, score.figures}));
  }
  return rows;
}

}  // namespace sprung
