#pragma once
/// Scales of sprung's own objects 0x2F01 on a Gold drive, shared with the simulated drives that decode them.
/// A real Gold has no standard object for position gains in physical units: these are sprung's choice, to be
/// replaced by the gain scheduling commands of the drive's own tool [unverified].
///
/// Position loop that the gains describe, in joint units about the gear's output side:
///
///   torque_Nm = stiffness * (target_rad - measured_rad)
///             + damping * (reference_velocity_rad_s - measured_velocity_rad_s)
///
/// where the reference velocity is the slope between set-points.
#include <cstdint>

namespace sprung::gold {

inline constexpr std::uint8_t kStiffnessSub = 1;       ///< u32
inline constexpr std::uint8_t kDampingSub = 2;         ///< u32
inline constexpr double kStiffnessUnit_Nm_rad = 1e-3;  ///< one count of 0x2F01:01, output side
inline constexpr double kDampingUnit_Nm_s_rad = 1e-3;  ///< one count of 0x2F01:02, output side

}  // namespace sprung::gold
