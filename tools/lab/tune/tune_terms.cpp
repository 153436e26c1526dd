#include "tools/lab/tune/tune_terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sprung {

namespace {

// Costs of a choice, not of nature: a fall must never pay, and height is worth about what two newton-metres
// are.
constexpr double kFall = 500.0;
constexpr double kFreeHeightError = 0.05;
constexpr double kPerHeightPercent_Nm = 2.0;
constexpr double kTieBreak = 0.1;  // of landing torque, where only standing counts

double mean_of_finite(const std::vector<JumpResult>& runs, double JumpResult::*member) {
  double sum = 0.0;
  int count = 0;
  for (const JumpResult& run : runs) {
    if (!std::isfinite(run.*member)) continue;
    sum += run.*member;
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

double height_error(const JumpResult& run, double height_mm) {
  return run.upright && std::isfinite(run.height_mm) ? std::fabs(run.height_mm / height_mm - 1.0) : 1.0;
}

std::array<double, 4> smaller_is_better(const TuneTerms& t) {
  return {t.landing_motor_Nm, t.landing_output_Nm, t.height_error, -t.upright};
}

/// Numbers that are missing never beat anything.
bool dominates(const TuneTerms& a, const TuneTerms& b) {
  const std::array<double, 4> x = smaller_is_better(a), y = smaller_is_better(b);
  bool better = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] <= y[i]) && !std::isnan(y[i])) return false;
    better = better || x[i] < y[i] || (std::isnan(y[i]) && !std::isnan(x[i]));
  }
  return better;
}

}  // namespace

std::vector<std::string> tune_objectives() {
  return {"landing_motor", "landing_output", "height_error", "upright"};
}

TuneObjective tune_objective(const std::string& text) {
  const std::vector<std::string> names = tune_objectives();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end())
    throw std::invalid_argument("no objective '" + text +
                                "'; there are landing_motor, landing_output, height_error, upright");
  return static_cast<TuneObjective>(found - names.begin());
}

TuneTerms tune_terms(const std::vector<JumpResult>& runs, double height_mm) {
  TuneTerms terms;
  terms.landing_motor_Nm = mean_of_finite(runs, &JumpResult::landing_knee_torque_Nm);
  terms.landing_output_Nm = mean_of_finite(runs, &JumpResult::landing_knee_output_torque_Nm);
  double error = 0.0;
  int upright = 0;
  for (const JumpResult& run : runs) {
    terms.worst_landing_output_Nm = std::fmax(terms.worst_landing_output_Nm,
                                              run.landing_knee_output_torque_Nm);
    error += height_error(run, height_mm);
    upright += run.upright ? 1 : 0;
  }
  if (runs.empty()) return terms;
  terms.height_error = error / static_cast<double>(runs.size());
  terms.upright = upright / static_cast<double>(runs.size());
  return terms;
}

double tune_cost(const TuneTerms& terms, TuneObjective objective) {
  const double falls = kFall * (1.0 - terms.upright);
  const double height = 100.0 * kPerHeightPercent_Nm * std::fmax(0.0, terms.height_error - kFreeHeightError);
  const auto or_fall = [](double torque_Nm) { return std::isfinite(torque_Nm) ? torque_Nm : kFall; };
  switch (objective) {
    case TuneObjective::kLandingMotor:
      return or_fall(terms.landing_motor_Nm) + height + falls;
    case TuneObjective::kLandingOutput:
      return or_fall(terms.landing_output_Nm) + height + falls;
    case TuneObjective::kHeightError:
      return 100.0 * terms.height_error + falls;
    case TuneObjective::kUpright:
      break;
  }
  return falls + kTieBreak * or_fall(terms.landing_output_Nm);
}

std::string cost_text(TuneObjective objective) {
  const std::string falls = " + 500 times the share of plants on which it does not end upright";
  const std::string height = " + 2 for each per cent of mean height error over 5 %";
  switch (objective) {
    case TuneObjective::kLandingMotor:
      return "mean peak of the knee's motor-side torque in the landing, Nm" + height + falls;
    case TuneObjective::kLandingOutput:
      return "mean peak of the knee's true gear output torque in the landing, Nm" + height + falls;
    case TuneObjective::kHeightError:
      return "mean height error, per cent" + falls;
    case TuneObjective::kUpright:
      break;
  }
  return "0.1 of the mean peak of the knee's true gear output torque in the landing, Nm" + falls;
}

std::vector<std::size_t> pareto_front(const std::vector<TuneTerms>& all) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool beaten = std::any_of(all.begin(), all.end(),
                                    [&](const TuneTerms& other) { return dominates(other, all[i]); });
    if (!beaten) front.push_back(i);
  }
  return front;
}

}  // namespace sprung
