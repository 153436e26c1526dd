#include "tools/lab/bring_up/never_identified.h"

namespace sprung {
namespace {

constexpr double kLeastDoubted = 0.95;  ///< share of the joints
constexpr double kLeastCovered = 0.90;
constexpr double kLeastFound_percent = 97.0, kMostFalseAlarms_percent = 2.0;
constexpr double kMostOverPaper = 1.0;

bool begins(const std::string& name, const std::string& with) { return name.rfind(with, 0) == 0; }
bool ends(const std::string& name, const std::string& with) {
  return name.size() >= with.size() && name.compare(name.size() - with.size(), with.size(), with) == 0;
}

Bounds demand(const std::string& name) {
  if (name == "model_watch.misfit_within_1s") return at_least(kLeastDoubted);
  if (name == "estimator.bounds.pooled.coverage") return at_least(kLeastCovered);
  if (begins(name, "estimator.contact.") && ends(name, ".found")) return at_least(kLeastFound_percent);
  if (begins(name, "estimator.contact.") && ends(name, ".false_alarms"))
    return at_most(kMostFalseAlarms_percent);
  // Without it the rows above would not be there, and nobody would miss them.
  if (name == "model_watch.completed" || name == "estimator.completed" || name == "drop.completed")
    return at_least(1.0);
  if (begins(name, "drop.adaptive_over_paper") && ends(name, "ratio")) return at_most(kMostOverPaper);
  return {};
}

}  // namespace

std::vector<ReportRow> never_identified(std::vector<ReportRow> rows) {
  for (ReportRow& one : rows) {
    const Bounds wanted = demand(one.name);
    one.low = wanted.low;
    one.high = wanted.high;
  }
  return rows;
}

}  // namespace sprung
