#include "estimator/identification/fit_warnings.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kCorrelated = 0.95;
constexpr double kFewSamples = 5.0;  ///< effective samples for each parameter

const FitParameter& at(const std::vector<FitParameter>& parameters, Index i) { return parameters[i]; }

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// "; record the joint loaded both ways, and slow reversals" or nothing.
std::string remedy(const FitParameter& a, const FitParameter& b) {
  if (a.told_by.empty() && b.told_by.empty()) return "; record motion that changes one and not the other";
  if (a.told_by == b.told_by || b.told_by.empty()) return "; record " + a.told_by;
  return "; record " + (a.told_by.empty() ? b.told_by : a.told_by + ", or " + b.told_by);
}

std::string cannot_tell(const FitParameter& a, const FitParameter& b, const std::string& why) {
  return "the data cannot tell '" + a.name + "' from '" + b.name + "' (" + why + ")" + remedy(a, b);
}

/// The two parameters that a direction is most made of; the same one twice where it is alone.
std::string of_hidden(const std::vector<FitParameter>& parameters, const Eigen::VectorXd& direction) {
  Index first = 0;
  direction.cwiseAbs().maxCoeff(&first);
  Eigen::VectorXd rest = direction;
  rest[first] = 0.0;
  Index second = 0;
  if (rest.cwiseAbs().maxCoeff(&second) < 0.1)
    return "the data say nothing about '" + at(parameters, first).name + "'" +
           remedy(at(parameters, first), at(parameters, first));
  if (second < first) std::swap(first, second);
  return cannot_tell(at(parameters, first), at(parameters, second), "changing both together changes nothing");
}

void warn_of_pairs(const std::vector<FitParameter>& parameters, const Eigen::MatrixXd& correlation,
                   std::vector<std::string>& out) {
  for (Index i = 0; i < correlation.rows(); ++i) {
    for (Index j = i + 1; j < correlation.cols(); ++j) {
      if (std::abs(correlation(i, j)) > kCorrelated)
        out.push_back(cannot_tell(at(parameters, i), at(parameters, j),
                                  "correlation " + number("%+.3f", correlation(i, j))));
    }
  }
}

void warn_of_single(const std::vector<FitParameter>& parameters, const Fit& fit,
                    const FitStatistics& statistics, const std::vector<Eigen::VectorXd>& hidden,
                    std::vector<std::string>& out) {
  for (Index i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& p = at(parameters, i);
    if (fit.at_bound[i]) {
      if (p.lower != p.upper)
        out.push_back("'" + p.name + "' ended on its bound " + number("%g", fit.parameters[i]) + " " +
                      p.unit + ": the data ask for none of it, or for more than makes sense");
    } else if (std::isnan(statistics.standard_error[i]) && hidden.empty()) {
      out.push_back("the data say nothing about '" + p.name + "'" + remedy(p, p));
    }
  }
}

}  // namespace

std::vector<std::string> fit_warnings(const std::vector<FitParameter>& parameters, const Fit& fit,
                                      const FitStatistics& statistics,
                                      const std::vector<Eigen::VectorXd>& hidden) {
  std::vector<std::string> out;
  out.reserve(hidden.size());
  for (const Eigen::VectorXd& direction : hidden) out.push_back(of_hidden(parameters, direction));
  warn_of_pairs(parameters, statistics.correlation, out);
  warn_of_single(parameters, fit, statistics, hidden, out);
  if (statistics.effective_samples < kFewSamples * static_cast<double>(parameters.size()))
    out.push_back("the data are worth only " + number("%.0f", statistics.effective_samples) +
                  " independent samples for " + std::to_string(parameters.size()) +
                  " parameters: standard errors are rough; record longer");
  if (!fit.converged) out.push_back("the search ended before it had settled: do not trust this fit");
  return out;
}

}  // namespace sprung::identification
