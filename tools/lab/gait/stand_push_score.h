#pragma once
/// How hard a disturbance is for the legs of a standing robot: what hip and knee carry above what they carry
/// anyway, and where the feet are afterwards. Pure.
#include <vector>

#include "signals/vec3.h"

namespace sprung {

/// Of one cycle.
struct PushSample {
  double time_s = 0.0;                 ///< since the push began; negative before
  std::vector<double> gear_output_Nm;  ///< true, of every hip and knee
  std::vector<double> motor_side_Nm;   ///< the papers' joint torque (their equation (6)) of the same joints
  std::vector<Vec3> foot_in_trunk_m;   ///< true
};

struct PushScore {
  double static_output_Nm = 0.0;  ///< of the joint that carries most, before
  double excess_output_Nm = 0.0;  ///< largest |torque| since the push began less the joint's static one, of
                                  ///< all joints
  double excess_motor_Nm = 0.0;
  double foot_off_mm = 0.0;  ///< worst foot in the last half second, from where it was before
};

/// @param samples in order, at least one before the push and one after. @throws std::invalid_argument else.
PushScore score_push(const std::vector<PushSample>& samples);

/// `compliance` over `position`; NaN where there is nothing to compare with.
double push_ratio(double compliance_Nm, double position_Nm) noexcept;

}  // namespace sprung
