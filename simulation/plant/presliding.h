#pragma once
/// Dry friction that holds elastically: teeth and balls give way by some 0.1 mrad before they slide, and come
/// back on another path (facts papers D3, D4). Pure. Output side, as GearFriction.
///
/// Four springs in parallel, each with a slider in series (generalised Maxwell-slip): after a reversal the
/// torque follows the same curve, twice as wide, and a loop inside a loop closes, so that small oscillations
/// do not creep, as they do with Dahl's and LuGre's laws. A damper acts on what has not begun to slide.
#include <array>

namespace sprung::sim {

class Presliding {
 public:
  /// Stiffness that a step can take, as a share of mass over step squared: symplectic Euler is stable up
  /// to 4.
  static constexpr double kStiffest = 0.25;

  /// @param way_rad from rest until all of it slides, under `full_Nm`. @param mass_kg_m2 that it holds at
  /// least, for the damper.
  Presliding(double full_Nm, double way_rad, double mass_kg_m2) noexcept;

  /// Nothing strained.
  void reset() noexcept;
  /// Before anything slides: 4.25 times full_Nm / way_rad.
  double stiffness_Nm_rad() const noexcept;
  /// Sign of motion: what it takes from whoever moves it.
  double torque_Nm(double speed_rad_s) const noexcept;
  /// One step later. @param way_rad moved in it. @param dry_Nm at which it slides now.
  void move(double way_rad, double dry_Nm) noexcept;

 private:
  static constexpr std::size_t kSprings = 4;
  std::array<double, kSprings> stiffness_Nm_rad_{};
  std::array<double, kSprings> springs_Nm_{};
  std::array<bool, kSprings> slides_{};
  double damping_Nm_s_rad_;  ///< while nothing slides
};

}  // namespace sprung::sim
