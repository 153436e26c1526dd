#pragma once
/// The modes of a simulated EPOS2 that make their reference by themselves: profile position (1), profile
/// velocity (3) and velocity (-2). Pure. All of them end in the position regulator here, whose weights are
/// known; a real EPOS2 has a velocity regulator (0x60F9) whose units are not [U].
///
/// Profile position, by CiA 402: a rising edge of control bit 4 takes 0x607A (bit 6: relative to the last
/// target), at once with bit 5, else after the motion under way; status bit 12 is on from then until bit 4
/// falls.
#include "drivers/profiles/epos2/epos2_units.h"
#include "simulation/node/cia402_drive.h"
#include "simulation/node/profile_motion.h"

namespace sprung::sim {

class Epos2Motion {
 public:
  /// @param rpm_per_rad_s of the motor for the gear's output. @param dictionary outlives this.
  Epos2Motion(const ObjectDictionary& dictionary, double rpm_per_rad_s) noexcept
      : dictionary_(dictionary), rpm_per_rad_s_(rpm_per_rad_s) {}

  /// Does nothing in other modes than its own.
  static bool drives(ModeUse mode) noexcept;
  /// Once a tick.
  void step(const DriveMoment& now) noexcept;
  PositionLoop::Reference reference() const noexcept { return motion_.reference(); }
  /// Status bits 10, 12 and 13 that these modes have.
  std::uint16_t status_bits(const DriveMoment& now) const noexcept;
  void forget() noexcept { active_ = false; }

 private:
  double object(std::uint16_t index) const noexcept;
  double counts_s(double rpm, const DriveMoment& now) const noexcept;
  ProfileLimits limits(const DriveMoment& now) const noexcept;
  void take_target() noexcept;

  const ObjectDictionary& dictionary_;
  double rpm_per_rad_s_;
  ProfileMotion motion_;
  bool active_ = false;
  ModeUse mode_ = ModeUse::kNone;
  double target_counts_ = 0.0;
  bool waiting_ = false;       ///< a target was taken, for when the motion under way has ended
  double next_counts_ = 0.0;   ///< that one
  bool acknowledged_ = false;  ///< status bit 12
};

}  // namespace sprung::sim
