#pragma once
/// How fast a torque follows a step: pure, from samples once a cycle.
#include <vector>

#include "signals/vec3.h"

namespace sprung {

/// One joint's torques around a step. Zero is the first cycle whose DRIVE_COMMAND carries the step.
struct StepTrace {
  std::vector<double> time_s;
  std::vector<double> estimated_motor_side_Nm;  ///< the papers' signal: measured current
  std::vector<double> motor_Nm;                 ///< truth
  std::vector<double> output_Nm;                ///< of the gear, truth
};

/// What "all of it" is.
enum class StepEnd {
  kFinal,    ///< mean of the last kTail_s
  kHighest,  ///< the largest torque: where motion goes on and no final value exists
};

struct StepFigures {
  double start_Nm = kNaN;  ///< mean before zero
  double end_Nm = kNaN;
  double peak_Nm = kNaN;
  double peak_ms = kNaN;  ///< NaN: the final value is not exceeded by kOvershoot of the step
  double t90_ms = kNaN;   ///< 90 % of the way from start to end, between samples by a straight line

  static constexpr double kTail_s = 0.1;
  /// 4.8 Nm of the 48 Nm step here; the estimate wanders by 2.5 Nm.
  static constexpr double kOvershoot = 0.1;
};

/// Without samples before and after zero everything is NaN; times are, too, where the torque still grows at
/// the end of kHighest. @param torque_Nm as long as `time_s`, which ascends.
StepFigures step_figures(const std::vector<double>& time_s, const std::vector<double>& torque_Nm,
                         StepEnd end);

}  // namespace sprung
