#include "tools/lab/leg/step_response_score.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kShare = 0.9;

double mean(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += values[i];
  return to > from ? sum / static_cast<double>(to - from) : kNaN;
}

std::size_t index_at(const std::vector<double>& time_s, double when_s) {
  return static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), when_s - 1e-9) -
                                  time_s.begin());
}

/// First time from sample `from` on at which the torque has gone `share` of the way.
double crossing_s(const std::vector<double>& time_s, const std::vector<double>& torque_Nm, std::size_t from,
                  const StepFigures& step, double share) {
  const double way_Nm = step.end_Nm - step.start_Nm;
  double before = (torque_Nm[from] - step.start_Nm) / way_Nm;
  if (before >= share) return time_s[from];
  for (std::size_t i = from + 1; i < time_s.size(); ++i) {
    const double now = (torque_Nm[i] - step.start_Nm) / way_Nm;
    if (now >= share) return time_s[i - 1] + (share - before) / (now - before) * (time_s[i] - time_s[i - 1]);
    before = now;
  }
  return kNaN;
}

}  // namespace

StepFigures step_figures(const std::vector<double>& time_s, const std::vector<double>& torque_Nm,
                         StepEnd end) {
  StepFigures out;
  const std::size_t zero = index_at(time_s, 0.0);
  if (zero == 0 || zero >= time_s.size()) return out;
  out.start_Nm = mean(torque_Nm, 0, zero);
  const auto first = torque_Nm.begin() + static_cast<std::ptrdiff_t>(zero);
  const auto by_size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  out.end_Nm = end == StepEnd::kHighest
                   ? *std::max_element(first, torque_Nm.end(), by_size)
                   : mean(torque_Nm, index_at(time_s, time_s.back() - StepFigures::kTail_s), time_s.size());
  const double sign = out.end_Nm < out.start_Nm ? -1.0 : 1.0;
  const auto peak = std::max_element(first, torque_Nm.end(),
                                     [=](double a, double b) { return sign * a < sign * b; });
  out.peak_Nm = *peak;
  if (end == StepEnd::kHighest && peak + 1 == torque_Nm.end()) return out;
  const double over_Nm = sign * (out.peak_Nm - out.end_Nm);
  const bool is_peak = end == StepEnd::kHighest ||
                       over_Nm > StepFigures::kOvershoot * std::abs(out.end_Nm - out.start_Nm);
  if (is_peak) out.peak_ms = 1e3 * time_s[peak - torque_Nm.begin()];
  out.t90_ms = 1e3 * crossing_s(time_s, torque_Nm, zero, out, kShare);
  return out;
}

}  // namespace sprung
