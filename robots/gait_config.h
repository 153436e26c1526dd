#pragma once
/// What robot.yaml says about a body on several legs: its mass, its gaits, and a preset's law of walking.
/// docs/locomotion.md.
#include <array>
#include <string>
#include <vector>

namespace sprung {

/// Virtual spring and damper at a foot.
struct StiffnessConfig {
  std::array<double, 3> stiffness_N_m{};  ///< x, y, z
  std::array<double, 3> damping_N_s_m{};
  double velocity_feedforward = 0.0;  ///< share of desired foot velocity in the damping term
};

/// A real IMU and what is known of it; sprung-imu-driver reads it. docs/drivers.md, "IMU".
struct ImuDriverConfig {
  std::string device;  ///< serial line, e.g. /dev/ttyUSB0; empty = there is none
  int baud = 115200;
  /// Trunk axes to sensor axes: the sensor is turned by yaw about z, then by pitch about the new y, then by
  /// roll about the new x.
  double mounting_roll_rad = 0.0;
  double mounting_pitch_rad = 0.0;
  double mounting_yaw_rad = 0.0;
  double latency_s = 0.0;          ///< from a measurement to its first byte here
  double range_rad_s = 0.0;        ///< of the gyroscopes: a rate beyond it is clipped
  double range_m_s2 = 0.0;         ///< of the accelerometers
  double longest_silence_s = 0.0;  ///< then the sensor counts as gone
};

/// The trunk, without legs (their masses are their links').
struct BodyConfig {
  double mass_kg = 0.0;                    ///< 0: the robot has no body that could fall
  std::array<double, 3> com_in_trunk_m{};  ///< from the middle of the hips
  std::array<double, 3> inertia_kg_m2{};   ///< about its axes
  bool imu = false;                        ///< somebody publishes IMU
  /// From what an IMU sample measured to the SYNC of its cycle: its filter's, which no driver takes off.
  double imu_latency_s = 0.0;
  ImuDriverConfig imu_driver;
  double fallen_tilt_rad = 0.0;  ///< roll or pitch beyond which the robot counts as fallen
  double fallen_height_m = 0.0;  ///< height of the hips over the standing feet, below which it does
  bool meets_falls = true;       ///< with its legs, before it is down; else they are damped alone
};

/// A pattern of steps: data, checked when it is read. A leg swings from its offset for (1 - duty) of the
/// period.
struct GaitConfig {
  std::string name;
  double period_s = 0.0;
  double duty = 1.0;            ///< share of the period in which a foot stands; 1: it never swings
  std::vector<double> offsets;  ///< one for each leg, share of the period, 0..1
  double lift_m = 0.0;          ///< of a foot over the line from where it left to where it lands
  double pre_stance = 0.3;      ///< share of the swing, at its end, in which the leg expects the ground
  double sway_m = 0.0;  ///< how far the body leans over the feet that go on standing, at most; 0: it does not
  double height_m = 0.0;      ///< of the hips over the feet where nobody asks for another; 0: the preset's
  double approach_m_s = 0.0;  ///< at which a foot comes down where the ground is expected; 0: the preset's
  double fastest_forward_m_s = 0.0;
  double fastest_backward_m_s = 0.0;  ///< legs swing differently: motors may have less speed for that way
  double fastest_sideways_m_s = 0.0;
  double fastest_turning_rad_s = 0.0;
  std::vector<std::string> to;  ///< gaits that may follow it without standing still in between
};

/// The law of walking of a preset.
struct WalkConfig {
  StiffnessConfig stance;
  StiffnessConfig swing;           ///< GaitControl::kForce
  StiffnessConfig pre_stance;      ///< GaitControl::kPreStance, the papers'
  bool distribute_force = false;   ///< false: virtual springs alone, as in the papers
  double floor_friction = 0.5;     ///< of the cones that forces stay in
  double stance_width_m = 0.0;     ///< how much further out than its hip each foot stands
  double force_rise_s = 0.0;       ///< in which a foot that has landed takes up its share
  double approach_m_s = 0.0;       ///< GaitControl::kAdaptive: how fast a foot comes down where the ground is
                                   ///< expected, unless the gait says
  double step_down_m = 0.0;        ///< how far a foot reaches below the expected ground before it gives up
  double acceleration_m_s2 = 0.0;  ///< of the desired speed
  double turning_acceleration_rad_s2 = 0.0;
  /// How far a foot is set beyond its place, per m/s that the body is too fast.
  double foothold_gain_s = 0.0;
  /// Roll Nm/rad, pitch Nm/rad, height N/m; what the springs at the feet do not give.
  std::array<double, 3> body_stiffness{};
  std::array<double, 3> body_damping{};       ///< roll Nm s/rad, pitch Nm s/rad, height N s/m
  std::array<double, 2> speed_damping{};      ///< forward and sideways, N s/m
  double stance_friction_compensation = 0.0;  ///< share, of a standing foot's joints in a gait that steps
  /// Of what compliance compensates, of feet that only stand. Feet of a pegasus that was lifted and set down
  /// stay up to 4.9 mm off with this (eight seeds), 6.5 mm with 0.9, 7.5 mm with 0.97, and 11 mm with the 0.5
  /// of a gait that steps: docs/locomotion.md, "Standing, pushed".
  double standing_friction_share = 0.93;
  double swing_inertia_compensation = 0.0;   ///< share, fed forward to position loops of swinging legs; on
                                             ///< springs none
  double swing_friction_compensation = 0.0;  ///< share, fed forward in the same way, and on the springs of
                                             ///< kForce
};

}  // namespace sprung
