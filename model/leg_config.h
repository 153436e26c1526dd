#pragma once
/// What a leg is made of: robots/<name>/robot.yaml, `legs`.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sprung {

/// Uniform description of a link; centre of mass from the proximal joint.
struct LinkConfig {
  double length_m = 0.0;
  double mass_kg = 0.0;
  double com_m = 0.0;
  double inertia_kg_m2 = 0.0;  ///< about its own centre of mass
};

/// LegConfig::kinematics of joints alone: no foot is known, so they can be measured, damped and switched off,
/// but not told where to go.
inline constexpr const char* kNoKinematics = "none";
/// LegConfig::kinematics of a single swinging arm, as on a bench: it has an end that can be moved and pushed,
/// but nothing stands on it.
inline constexpr const char* kOneLink = "one_link";
/// LegConfig::kinematics of hip and knee in the x-z plane, frame of S0 (10), docs/sources.md (the papers' y
/// is our z): model/two_link.h.
inline constexpr const char* kTwoLink = "two_link";
/// LegConfig::kinematics of abduction, hip and knee: model/three_joint.h.
inline constexpr const char* kThreeJoint = "three_joint";

/// To which side of its abduction axis a three-joint leg's plane lies.
enum class LegSide : std::int8_t { kLeft = 1, kRight = -1 };

struct LegConfig {
  std::string name;
  /// One of the four above. kNoKinematics: `links` and `contact_*` are empty.
  std::string kinematics;
  LegSide side = LegSide::kLeft;  ///< of kThreeJoint alone
  std::vector<int> joints;        ///< indices into RobotConfig::joints, proximal first
  std::vector<int> actuators;     ///< indices into RobotConfig::actuators, same length
  /// joint = transmission * actuator, row-major joints x actuators.
  std::vector<double> transmission;
  std::vector<LinkConfig> links;  ///< thigh, shank; kThreeJoint: hip link (sideways), thigh, shank
  /// Origin of the hip's axes, in trunk axes, from the middle of the hips.
  std::array<double, 3> hip_in_trunk_m{};
  /// Of the ball about the end of the last link that stands on the ground. The foot of all kinematics is its
  /// centre; 0 = the foot is a point.
  double foot_radius_m = 0.0;
  double contact_on_N = 0.0;    ///< vertical foot force above which contact is declared
  double contact_off_N = 0.0;   ///< below which it is lost
  double contact_rise_s = 0.0;  ///< must last this long
  double contact_fall_s = 0.0;
};

}  // namespace sprung
