#include "estimator/identification/raw_series.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimator/identification/local_polynomial.h"

namespace sprung::identification {

namespace {

using Index = Eigen::Index;
using Signal = std::vector<double>;

constexpr double kShortestWindow_s = 0.03;
/// In a window. The rotor's own inertia shows in fast changes of speed: on UR10e joint 1 at 100 Hz the
/// training half's cross-validated R2 is 0.9953 with 3 samples, 0.9928 with 5, 0.9910 with 9 (Coulomb +
/// viscous). Positions alone need more: their second derivative is noisier.
constexpr int kFewestVelocities = 3;
constexpr int kFewestPositions = 9;

struct NamedSignal {
  const char* name;
  Signal RawSeries::*raw;
  Eigen::VectorXd JointDataset::*out;  ///< null: not of the dataset
  bool required;
};

const NamedSignal kSignals[] = {
    {"position", &RawSeries::position_rad, &JointDataset::position_rad, true},
    {"velocity", &RawSeries::velocity_rad_s, &JointDataset::velocity_rad_s, false},
    {"measured torque", &RawSeries::measured_torque, &JointDataset::measured_torque, true},
    {"link position", &RawSeries::link_position_rad, &JointDataset::link_position_rad, false},
    {"load", &RawSeries::load_Nm, &JointDataset::load_Nm, false},
    {"load inertia", &RawSeries::load_inertia_kg_m2, &JointDataset::load_inertia_kg_m2, false},
    {"temperature", &RawSeries::temperature_C, &JointDataset::temperature_C, false},
    {"weight", &RawSeries::weight, nullptr, false},
};
constexpr std::size_t kWeight = std::size(kSignals) - 1;

[[noreturn]] void refuse(const std::string& problem) { throw std::invalid_argument(problem); }

void check_finite(const char* name, const Signal& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      refuse(std::string(name) + " of sample " + std::to_string(i) + " is not a finite number");
  }
}

void check(const RawSeries& series) {
  const std::size_t n = series.time_s.size();
  if (n == 0) refuse("there are no samples");
  check_finite("time", series.time_s);
  for (const NamedSignal& signal : kSignals) {
    const Signal& values = series.*signal.raw;
    if (values.empty() && !signal.required) continue;
    if (values.size() != n)
      refuse(std::string(signal.name) + " has " + std::to_string(values.size()) + " samples, time has " +
             std::to_string(n));
    check_finite(signal.name, values);
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (series.time_s[i] < series.time_s[i - 1])
      refuse("time goes back at sample " + std::to_string(i) + ": " + std::to_string(series.time_s[i]) +
             " s after " + std::to_string(series.time_s[i - 1]) + " s; is another clock's column meant?");
  }
}

/// Samples of one time stamp become one with their mean.
struct MergedSeries {
  Signal time_s;
  Signal values[std::size(kSignals)];
};

MergedSeries merge(const RawSeries& series, const TimeSpan& span) {
  MergedSeries out;
  std::size_t count = 0;  // samples of the newest time stamp
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    const double time_s = series.time_s[i] - series.time_s.front();
    if (time_s < span.from_s || time_s >= span.to_s) continue;
    const bool repeated = !out.time_s.empty() && time_s == out.time_s.back();
    count = repeated ? count + 1 : 1;
    if (!repeated) out.time_s.push_back(time_s);
    for (std::size_t s = 0; s < std::size(kSignals); ++s) {
      const Signal& values = series.*kSignals[s].raw;
      if (values.empty()) continue;
      if (!repeated) out.values[s].push_back(0.0);
      double& mean = out.values[s].back();
      mean += (values[i] - mean) / static_cast<double>(count);
    }
  }
  return out;
}

double median_interval(const Signal& time_s) {
  Signal intervals;
  for (std::size_t i = 1; i < time_s.size(); ++i) intervals.push_back(time_s[i] - time_s[i - 1]);
  if (intervals.empty()) refuse("one sample alone gives no motion");
  std::nth_element(intervals.begin(), intervals.begin() + static_cast<Index>(intervals.size() / 2),
                   intervals.end());
  return intervals[intervals.size() / 2];
}

/// First and last grid point between two samples.
struct Grid {
  Index first;
  Index last;
};

/// Rounding of time stamps must not lose the grid point that a sample lies on.
constexpr double kGridSlack = 1e-6;

Grid grid_between(double from_s, double to_s, const TimeSpan& span, double period_s) {
  return {static_cast<Index>(std::ceil((from_s - span.from_s) / period_s - kGridSlack)),
          static_cast<Index>(std::floor((to_s - span.from_s) / period_s + kGridSlack))};
}

Eigen::VectorXd interpolate(const Signal& time_s, const Signal& values, const Eigen::VectorXd& at_s) {
  Eigen::VectorXd out(at_s.size());
  std::size_t right = 1;
  for (Index i = 0; i < at_s.size(); ++i) {
    while (right + 1 < time_s.size() && time_s[right] < at_s[i]) ++right;
    const double share = (at_s[i] - time_s[right - 1]) / (time_s[right] - time_s[right - 1]);
    out[i] = values[right - 1] + std::clamp(share, 0.0, 1.0) * (values[right] - values[right - 1]);
  }
  return out;
}

void differentiate(JointDataset& data, const PrepareOptions& options) {
  const int fewest = data.velocity_rad_s.size() > 0 ? kFewestVelocities : kFewestPositions;
  const double window_s = options.smoothing_s > 0.0 ? options.smoothing_s
                                                    : std::max(kShortestWindow_s, fewest * data.period_s);
  const int half = std::max(1, static_cast<int>(std::lround((window_s / data.period_s - 1.0) / 2.0)));
  const int degree = std::max(2, options.smoothing_degree);
  if (data.velocity_rad_s.size() > 0) {
    data.acceleration_rad_s2 = local_polynomial(data.velocity_rad_s, data.period_s, half, degree, 1);
    return;
  }
  data.velocity_rad_s = local_polynomial(data.position_rad, data.period_s, half, degree, 1);
  data.acceleration_rad_s2 = local_polynomial(data.position_rad, data.period_s, half, degree, 2);
}

void accelerate_load(JointDataset& data) {
  if (data.load_inertia_kg_m2.size() == 0 || !data.has_load()) return;
  data.load_Nm.array() += data.load_inertia_kg_m2.array() * data.acceleration_rad_s2.array();
}

Eigen::VectorXd counted(const Signal& time_s, const Signal& weight, const Eigen::VectorXd& at_s) {
  if (weight.empty()) return Eigen::VectorXd::Ones(at_s.size());
  return interpolate(time_s, weight, at_s).unaryExpr([](double w) { return w > 1.0 - 1e-9 ? 1.0 : 0.0; });
}

/// Of the samples `begin`..`end`-1, between which there is no gap. Empty where they hold too few grid points.
FitPiece piece_of(const MergedSeries& merged, std::size_t begin, std::size_t end, const RawSeries& series,
                  const TimeSpan& span, double period_s) {
  FitPiece piece;
  JointDataset& data = piece.data;
  data.period_s = period_s;
  data.gear_ratio = series.gear_ratio;
  data.torque_unit = series.torque_unit;
  data.load_beside_own = series.load_beside_own;
  if (end - begin < 2) return piece;
  const Grid grid = grid_between(merged.time_s[begin], merged.time_s[end - 1], span, period_s);
  const Index count = grid.last - grid.first + 1;
  if (count < 3) return piece;
  data.time_s.resize(count);
  for (Index i = 0; i < count; ++i)
    data.time_s[i] = span.from_s + static_cast<double>(grid.first + i) * period_s;
  const auto part = [&](const Signal& all) {
    if (all.empty()) return Signal();
    return Signal(all.begin() + static_cast<Index>(begin), all.begin() + static_cast<Index>(end));
  };
  const Signal time_s = part(merged.time_s);
  for (std::size_t s = 0; s < kWeight; ++s) {
    if (!merged.values[s].empty())
      data.*kSignals[s].out = interpolate(time_s, part(merged.values[s]), data.time_s);
  }
  piece.weight = counted(time_s, part(merged.values[kWeight]), data.time_s);
  return piece;
}

}  // namespace

std::vector<FitPiece> prepare(const RawSeries& series, const TimeSpan& span, const PrepareOptions& options) {
  check(series);
  const MergedSeries merged = merge(series, span);
  const std::size_t n = merged.time_s.size();
  if (n < 2)
    refuse("there are " + std::to_string(n) + " samples between " + std::to_string(span.from_s) + " and " +
           std::to_string(span.to_s) + " s; the recording lasts " +
           std::to_string(series.time_s.back() - series.time_s.front()) + " s");
  const double period_s = options.rate_Hz > 0.0 ? 1.0 / options.rate_Hz : median_interval(merged.time_s);
  const double gap_s = options.longest_gap_s > 0.0 ? options.longest_gap_s
                                                   : std::max(0.1, 5.0 * median_interval(merged.time_s));
  std::vector<FitPiece> pieces;
  for (std::size_t begin = 0, end = 1; begin < n; begin = end++) {
    while (end < n && merged.time_s[end] - merged.time_s[end - 1] <= gap_s) ++end;
    FitPiece piece = piece_of(merged, begin, end, series, span, period_s);
    if (piece.data.size() == 0) continue;
    differentiate(piece.data, options);
    accelerate_load(piece.data);
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) refuse("no stretch without a gap is long enough to be used");
  return pieces;
}

Eigen::VectorXd weight_within(const JointDataset& data, const std::vector<TimeSpan>& spans) {
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(data.size());
  // A grid point that rounding puts a hair below the border still lies on it.
  const double slack_s = kGridSlack * data.period_s;
  for (Index i = 0; i < data.size(); ++i) {
    for (const TimeSpan& span : spans) {
      const double time_s = data.time_s[i] + slack_s;
      if (time_s >= span.from_s && time_s < span.to_s) weight[i] = 1.0;
    }
  }
  return weight;
}

}  // namespace sprung::identification
