#pragma once
/// What the estimator may take for granted of a robot's currents, encoders and loads: robot.yaml's
/// `estimation`. Every key may be missing; the defaults are those of the papers' leg.

namespace sprung {

struct EstimationConfig {
  /// Turns of a drive's torque loop in a second: it holds its current for one of them (facts A1).
  double drive_loop_kHz = 4.0;
  /// One standard deviation of the instant at which a drive reads its encoder. Facts physics 11: more than
  /// 1 us shows in every derivative.
  double sampling_jitter_us = 2.0;
  /// One standard deviation of a drive's current, as torque at the joint (facts C2).
  double current_noise_Nm = 0.5;
  /// Random walk of the gear output torque: 1.8 Nm in 1 ms. Found on hybrid jumps of the papers' leg
  /// (docs/estimation.md, "The filter"): a share of the torque that an impact asks of the gear.
  double load_walk_Nm_sqrt_s = 57.0;
  /// One standard deviation of the force along the floor on a foot that lands under a trunk that moves:
  /// friction 0.6 of the 170 N that pegasus' feet meet in a trot. Of robots with a `body`.
  double floor_force_N = 100.0;
  /// Whether friction is learnt while the robot works (estimator/friction_adaptation.h).
  bool adapts_friction = true;
};

}  // namespace sprung
