#pragma once
/// How a simulated motor truly hangs on its drive, and what the drive was told about it: pole pairs, phases,
/// encoder, commutation angle and current gains. A drive that knows its motor never needs any of this; one
/// that is to be commissioned does. Pure; one tick at a time.
///
/// Field-oriented current of a permanent magnet motor. With the rotor's electrical angle phi and the angle
/// psi at which the drive puts its torque current, both in the motor's own forward direction:
///   torque = Kt I s cos(s psi - phi),   s = -1 where two phases are swapped, else 1.
/// The drive finds psi = phi + error from its Hall sensors when power comes on, and then counts on:
///   psi grows by  pole pairs it believes in * 2 pi * counts / counts a turn it believes in.
/// So a wrong number of pole pairs or counts lets the torque fade with the angle travelled, and swapped
/// phases or a reversed encoder lock the rotor in the next angle of no torque.
#include <cstdint>
#include <utility>
#include <vector>

#include "drivers/canopen/protocol.h"

namespace sprung::sim {

struct DriveWiring {
  bool given = false;  ///< false: the drive knows its motor, and all that follows is ignored
  int pole_pairs = 1;  ///< of the motor
  bool phases_swapped = false;
  bool encoder_reversed = false;
  bool encoder_dead = false;            ///< its cable is off
  bool emergency_dead = false;          ///< the emergency stop does not reach the drive's input
  double encoder_counts_per_turn = 0;   ///< of the disc; 0 = as robot.yaml of the machine says
  double commutation_error_rad = 0;     ///< electrical
  int drive_pole_pairs = 0;             ///< in a drive without an object for them; 0 = the motor's
  double fitting_p = 0, fitting_i = 0;  ///< current gains that give sim.yaml's torque_loop; 0 = not asked
  double gain_p = 1, gain_i = 1;        ///< in a drive without objects for them: of the fitting ones
  double voltage_A = 60;  ///< current that the supply drives through the winding at rest [design choice]
  /// Stored in the drive instead of what its EDS and make say.
  std::vector<std::pair<canopen::ObjectId, std::int64_t>> stored{};
};

/// What the drive's own objects say of its motor; 0 = the make has no such object.
struct MotorBelief {
  int pole_pairs = 0;
  double encoder_counts_per_turn = 0;
  bool encoder_inverted = false;
  double current_p = 0, current_i = 0;
};

/// A drive's current loop with gains that may not fit: PI on a winding, sampled, a period late; it swings up
/// where its bandwidth times one and a half periods is above about pi / 2.
/// Gains are shares of those that cancel the winding's time constant and give the loop its bandwidth.
class GainedCurrentLoop {
 public:
  static constexpr double kWinding_s = 1.1e-3;  ///< L / R [design choice], sim.yaml has 1.09 ms
  static constexpr double kPeriod_s = 1e-4;     ///< a 10 kHz loop [unverified: facts canopen 2.4]
  GainedCurrentLoop(double bandwidth_Hz, double step_s) noexcept;
  /// @param voltage_A what the converter can drive through the winding at rest.
  double step(double target_A, double gain_p, double gain_i, double voltage_A) noexcept;
  void switch_off() noexcept;
  double current_A() const noexcept { return current_A_; }

 private:
  void control(double error_A, double gain_p, double gain_i, double voltage_A) noexcept;

  double bandwidth_rad_s_;
  int substeps_, phase_ = 0;
  double current_A_ = 0, integral_A_ = 0, applied_A_ = 0, next_A_ = 0;
};

/// Share of Kt I that becomes torque.
class Commutation {
 public:
  explicit Commutation(const DriveWiring& wiring) noexcept;
  /// Power comes on: the Hall sensors are read.
  void align(double motor_rad, double counts) noexcept;
  /// @param counts as the drive reads them, with its polarity. @return -1..1.
  double share(double motor_rad, double counts, const MotorBelief& belief,
               double true_counts_per_turn) const noexcept;

 private:
  double pole_pairs_, drive_pole_pairs_, sign_, error_rad_;
  double start_rad_ = 0, start_counts_ = 0;
};

}  // namespace sprung::sim
