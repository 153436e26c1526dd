#pragma once
/// Measurements of one joint at a constant rate, ready to be fitted. Pure values.
/// Signs: positive torque accelerates the joint toward +q. Everything is on the joint side of the gear, at
/// the joint's own angle; "measured torque" is what the motor gives, R Kt i, or its current where Kt is not
/// known.
#include <Eigen/Core>
#include <string>

namespace sprung::identification {

/// One gapless recording. All vectors are of one length; those that may be missing are then empty.
struct JointDataset {
  double period_s = 0.0;                ///< between samples, > 0
  double gear_ratio = 1.0;              ///< motor turns per joint turn, > 0; motor angle = ratio * position
  std::string torque_unit = "Nm";       ///< of measured_torque: "Nm" at the joint, or "A" of motor current
  Eigen::VectorXd time_s;               ///< since the first sample of the recording
  Eigen::VectorXd position_rad;         ///< motor side over the ratio, or link side where only that is known
  Eigen::VectorXd velocity_rad_s;       ///< zero-phase
  Eigen::VectorXd acceleration_rad_s2;  ///< zero-phase
  Eigen::VectorXd measured_torque;      ///< in torque_unit, as recorded (resampled, not smoothed)
  Eigen::VectorXd link_position_rad;    ///< second encoder on the link side; may be missing
  Eigen::VectorXd load_Nm;  ///< torque that the gear is known to give to the link (torque sensor, or inverse
                            ///< dynamics plus force sensor); may be missing
  /// load_Nm is what a known weight adds; what the joint bears without it is fitted beside.
  bool load_beside_own = false;
  Eigen::VectorXd load_inertia_kg_m2;  ///< of that weight about the joint, in load_Nm already; may be missing
  Eigen::VectorXd temperature_C;       ///< of motor or gear; may be missing

  Eigen::Index size() const { return time_s.size(); }
  bool has_link_position() const { return link_position_rad.size() > 0; }
  bool has_load() const { return load_Nm.size() > 0; }
  bool has_temperature() const { return temperature_C.size() > 0; }
};

/// A dataset and what of it counts: a model with memory (hysteresis, temperature) runs over every sample in
/// order of time, and starts anew in every piece.
struct FitPiece {
  JointDataset data;
  Eigen::VectorXd weight;  ///< of each sample, >= 0; 0 = only drives the model's memory
};

}  // namespace sprung::identification
