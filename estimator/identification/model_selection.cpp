#include "estimator/identification/model_selection.h"

#include <algorithm>
#include <cstdio>

namespace sprung::identification {

namespace {

/// Share of the best model's mean squared error that is no reason for a parameter, however sure it is.
constexpr double kNegligible = 0.01;

std::size_t smallest_error(const std::vector<Candidate>& candidates) {
  const auto worse = [](const Candidate& a, const Candidate& b) {
    if (a.validation.out_of_bounds != b.validation.out_of_bounds) return a.validation.out_of_bounds;
    return a.validation.r2() < b.validation.r2();
  };
  const auto best = std::max_element(candidates.begin(), candidates.end(), worse);
  return static_cast<std::size_t>(best - candidates.begin());
}

bool simpler(const Candidate& a, const Candidate& b) {
  if (a.parameters != b.parameters) return a.parameters < b.parameters;
  return a.validation.r2() > b.validation.r2();
}

std::string said(const Candidate& candidate) {
  return "'" + candidate.name + "' (" + std::to_string(candidate.parameters) + " parameters)";
}

std::string reason(const Candidate& best, const Candidate& chosen) {
  if (&best == &chosen)
    return said(chosen) +
           " has the smallest error on left-out blocks, and nothing simpler comes within one standard error "
           "of it";
  const Difference behind = difference(chosen.validation, best.validation);
  char text[160];
  std::snprintf(
      text, sizeof text,
      " by %.5f of the variance, within the standard error %.5f of that or a hundredth of the error",
      behind.mean, behind.standard_error);
  return said(chosen) + " is behind the best one, " + said(best) + ", only" + text +
         "; nothing simpler is as close";
}

/// Those that would have been better.
std::string left_out(const std::vector<Candidate>& candidates, const Candidate& best) {
  std::string out;
  for (const Candidate& c : candidates) {
    if (c.validation.out_of_bounds && !best.validation.out_of_bounds &&
        c.validation.r2() > best.validation.r2())
      out += "; " + said(c) + " is left out, since its fit ends on a bound";
  }
  return out;
}

}  // namespace

const char* selection_criterion() {
  return "blocked cross-validation inside the training part with the one-standard-error rule: of the models "
         "whose mean "
         "squared error on left-out blocks is behind the best one's by no more than the standard error of "
         "that "
         "difference, or by no more than a hundredth of its error, the one with the fewest parameters; "
         "models whose fit ends on a bound other than zero "
         "are left out";
}

Selection select(const std::vector<Candidate>& candidates) {
  Selection out;
  out.best = out.chosen = smallest_error(candidates);
  const Candidate& best = candidates[out.best];
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].validation.out_of_bounds != best.validation.out_of_bounds) continue;
    const Difference behind = difference(candidates[i].validation, best.validation);
    const double enough = std::max(behind.standard_error, kNegligible * (1.0 - best.validation.r2()));
    if (behind.mean <= enough && simpler(candidates[i], candidates[out.chosen])) out.chosen = i;
  }
  out.why = reason(best, candidates[out.chosen]) + left_out(candidates, best);
  return out;
}

}  // namespace sprung::identification
