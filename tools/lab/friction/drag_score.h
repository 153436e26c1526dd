#pragma once
/// The estimate of the gear output torque against what was there. Pure.
#include <cstddef>
#include <vector>

namespace sprung {

struct DragSample {
  double time_s = 0.0;
  double reference_Nm = 0.0;  ///< torque sensor, or the simulation's truth
  double estimate_Nm = 0.0;   ///< gear output torque of JOINT_STATE
  double bound_Nm = 0.0;      ///< stated for 95 %
  double paper_Nm = 0.0;      ///< motor-side torque: S0 equation (6)
};

/// At a moment between two: in a straight line.
DragSample between(const DragSample& before, const DragSample& after, double time_s);

struct DragScore {
  std::size_t samples = 0;
  double rms_Nm = 0.0;
  double max_Nm = 0.0;
  double mean_Nm = 0.0;        ///< estimate minus reference
  double coverage = 0.0;       ///< share of samples with an error within the bound
  double half_width_Nm = 0.0;  ///< mean bound
  double paper_rms_Nm = 0.0;   ///< of S0's equation (6)
  double reference_rms_Nm = 0.0;
};
/// NaN in every figure where there are no samples; a sample whose estimate is NaN spoils what it enters.
DragScore drag_score(const std::vector<DragSample>& samples);

}  // namespace sprung
