#pragma once
/// What `sprung identify` found about a joint, as robot.yaml holds it: friction, where it comes from, how
/// certain the numbers are, and the gear's temperature.
#include <cstdint>
#include <limits>
#include <string>

#include "model/friction/friction_parameters.h"
#include "model/friction/thermal_state.h"

namespace sprung {

/// Which friction a controller compensates.
enum class CompensatedFriction : std::int8_t {
  kPaper,       ///< JointConfig::papers_friction, identified or not
  kIdentified,  ///< JointConfig::estimated_friction
};

/// Where the numbers come from, and how well they explain data that did not select them.
struct IdentificationRecord {
  std::string robot;   ///< whose joint was recorded; empty: nobody says, so this one's
  std::string date;    ///< YYYY-MM-DD
  std::string log;     ///< name of the recording
  std::string sha256;  ///< of the recording, at least the first 16 digits
  std::int64_t samples = 0;
  double held_out_r2 = 0.0;      ///< of the motor torque, in the part of the data that was held out
  double held_out_rms_Nm = 0.0;  ///< the same
  std::string command;
  /// At which it was recorded, as somebody has said; NaN: nobody has.
  double temperature_C = std::numeric_limits<double>::quiet_NaN();
  double supply_V = std::numeric_limits<double>::quiet_NaN();
  /// [design choice] After as many days `sprung up` asks for a new one: grease ages, gears wear in.
  int max_age_days = 90;
};

/// A robot begun as a copy of another has the other's numbers until its own joints are recorded.
inline bool identified_on_another(const IdentificationRecord& record, const std::string& robot) {
  return !record.robot.empty() && record.robot != robot;
}

struct IdentifiedFriction {
  FrictionModelKind model = FrictionModelKind::kCoulomb;
  FrictionParameters parameters;
  IdentificationRecord record;
};

/// Relative, one standard deviation each. Where robot.yaml is silent: friction within 25 %, torque constant
/// within 5 % and mass within 10 %, spread evenly (so 1 / sqrt 3 of these); armature from memory (facts C3,
/// [M]), where the plants that fit the papers ask for up to 0.35 more than the data sheets (facts C2).
struct JointUncertainty {
  double friction = 0.144;
  double torque_constant = 0.029;
  double armature = 0.2;
  double mass = 0.058;
};
/// Of friction that is a paper's: the same experiments need 7.3 Nm where the bench gave 1.79 (facts E12, C2,
/// E13), 3.1 times the value more, spread evenly.
inline constexpr double kPapersFrictionUncertainty = 1.8;

}  // namespace sprung
