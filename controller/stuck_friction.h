#pragma once
/// What a joint that stays stuck says of its friction: it holds at least what pushes. Where the virtual
/// spring pulls a foot home and the foot does not move, friction is more than its law says, and the share
/// that is compensated grows until the joint moves or friction of that kind is no longer likely. Pure.
///
///   s' = +kGrowth       |w| < kStuck, spring's torque tau_k of kDead tau0 at least, and little enough to be
///                       what the law may lack: |tau_k| + k T <= (1 + most) T; more is a hand, or the ground
///   s' = -s / kForget   the joint moves against its spring: a hand, or a foot that went too far
///   s = 0               where no friction is to be compensated, k = 0
///   0 <= s <= most      RestFrictionConfig::most; 0: nothing is learnt
///
/// Not of a foot in stance: four on one floor pull against each other, and what holds them is not the gears.
/// s is kept while the spring moves the joint, and acts as all of the rest law does: by the spring's sign, so
/// that it cannot drive a joint away from where it is to be (compliance_law.h).
#include "robots/robot_config.h"

namespace sprung {

struct StuckMoment {
  double velocity_rad_s = 0.0;
  double spring_torque_Nm = 0.0;   ///< tau_k
  double rest_friction_Nm = 0.0;   ///< T, by the law, >= 0
  double compensated_share = 0.0;  ///< k
};

class StuckFriction {
 public:
  explicit StuckFriction(const RestFrictionConfig& rest) noexcept : rest_(rest) {}
  void reset() noexcept { share_ = 0.0; }
  void step(const StuckMoment& now, double dt_s) noexcept;
  /// Of the law's friction, beside the preset's share.
  double share() const noexcept { return share_; }

 private:
  RestFrictionConfig rest_;
  double share_ = 0.0;
};

}  // namespace sprung
