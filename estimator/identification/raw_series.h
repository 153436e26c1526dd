#pragma once
/// From a recording as it is (jittered and repeated time stamps, gaps) to datasets at a constant rate. Pure.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/identification/dataset.h"

namespace sprung::identification {

/// A recording of one joint in order of time. Signals that were not recorded are empty.
struct RawSeries {
  double gear_ratio = 1.0;
  std::string torque_unit = "Nm";
  std::vector<double> time_s;
  std::vector<double> position_rad;
  std::vector<double> velocity_rad_s;  ///< empty: from position
  std::vector<double> measured_torque;
  std::vector<double> link_position_rad;
  std::vector<double> load_Nm;
  bool load_beside_own = false;  ///< as JointDataset's
  /// Of what makes the load: what it takes to accelerate it is added to load_Nm.
  std::vector<double> load_inertia_kg_m2;
  std::vector<double> temperature_C;
  /// 1 = counts, 0 = only drives memory (another joint moves, drive off); empty: all 1.
  std::vector<double> weight;
};

struct PrepareOptions {
  double rate_Hz = 0.0;        ///< of the datasets; 0 = 1 / median interval of the recording
  double smoothing_s = 0.0;    ///< whole width of the local fits for acceleration, and for velocity where it
                               ///< was not recorded; 0 = three samples (nine, where positions alone are), and
                               ///< 0.03 s at least
  int smoothing_degree = 2;    ///< of the local polynomials, >= 2
  double longest_gap_s = 0.0;  ///< a longer one is not bridged: a new piece begins; 0 = 0.1 s or five median
                               ///< intervals
};

/// A part of a recording, seconds after its first sample; `to_s` is not in it.
struct TimeSpan {
  double from_s = 0.0;
  double to_s = 0.0;
};

/// Time is counted from the first sample of `series`. Samples with one time stamp are merged into their mean;
/// between samples the line is taken; grid points lie at multiples of the period after `span.from_s`, so that
/// datasets of parts share the grid of the whole. Only samples within the span are looked at, smoothing
/// included: a part prepared by itself knows nothing of its neighbours. Grid points beside a sample that does
/// not count do not count.
/// @throws std::invalid_argument naming the problem: lengths that differ, values that are not finite, time
/// that goes back, nothing within the span.
std::vector<FitPiece> prepare(const RawSeries& series, const TimeSpan& span, const PrepareOptions& options);

/// 1 for samples within one of the spans, else 0.
Eigen::VectorXd weight_within(const JointDataset& data, const std::vector<TimeSpan>& spans);

}  // namespace sprung::identification
