#pragma once
/// Parameters of adaptive landing, the law of planner/adaptive_landing.h: a preset's optional key
/// `adaptive_landing`.
namespace sprung {

/// What the foot is to feel like along x and z in one phase of the landing: a spring, a damper, and the mass
/// that the rotors are made to have there.
struct LandingGains {
  double mass_x_kg = 0.0;  ///< 0: the rotors' own, as their gears make it
  double mass_z_kg = 0.0;
  double stiffness_x_N_m = 0.0;
  double stiffness_z_N_m = 0.0;
  double damping_x_N_s_m = 0.0;
  double damping_z_N_s_m = 0.0;
};

struct AdaptiveLandingConfig {
  double extended_length_m = 0.0;        ///< to which the leg stretches first; 0: the hybrid law instead
  double extension_s = 0.0;              ///< in which it does so; less of both where the fall is short
  double stretch_acceleration_m_s2 = 0;  ///< of the foot while it does, at most
  double foot_x_m = 0.0;                 ///< of the foot ahead of the hip at touchdown
  double braking_m_s2 = 0.0;             ///< of the foot over ground, before contact
  double braking_jerk_m_s3 = 0.0;        ///< with which braking begins and ends
  double approach_share = 1.0;           ///< of the hip's speed at touchdown: the foot's once it has braked
  double approach_m_s = 0.0;             ///< the same at most
  double early_m = 0.0;                  ///< above the expected ground where it has braked
  double fastest_m_s = 0.0;              ///< that the leg is drawn in before contact: its joints' speed limit
  double timing_s = 0.0;      ///< touchdown may come this much early; a push before must last longer to count
  double shortest_m = 0.0;    ///< leg's length at which the body has stopped
  double body_mass_kg = 0.0;  ///< that a leg carries
  double force_rise_s = 0.0;  ///< from contact to the whole planned force
  double inertia_compensation = 0.0;   ///< share of the rotors' inertia
  double friction_compensation = 0.0;  ///< share, in the air
  double ground_friction_compensation = 0.0;
  double measured_force_share = 0.0;  ///< of the vertical force that the motors take off the rotors
  double mass_s = 0.0;                ///< after contact, in which the masses give way to the rotors' own
  LandingGains air;
  LandingGains ground;
};

}  // namespace sprung
