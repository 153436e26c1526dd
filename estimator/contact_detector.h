#pragma once
/// Is the foot on the ground? From the estimated vertical force, with hysteresis, separate rise and fall
/// delays in message time, and respect for what the estimate cannot know. Pure.
#include "robots/robot_config.h"

namespace sprung {

struct ContactParams {
  double on_N = 0.0;    ///< contact is declared above this, > off_N
  double off_N = 0.0;   ///< and lost below this
  double rise_s = 0.0;  ///< must last this long, >= 0
  double fall_s = 0.0;
};

struct [[nodiscard]] ContactEstimate {
  bool contact = false;
  double confidence =
      0.0;  ///< that the foot is on the ground: 0.5 between the thresholds, 0 when the force is not finite
};

class ContactDetector {
 public:
  /// @throws std::invalid_argument unless on > off and no delay is negative.
  explicit ContactDetector(const ContactParams& params);
  void reset() noexcept;
  /// @param force_bound_N how wrong the force may be. Contact is declared only when it is above the threshold by more than
  ///        that, so that neither a swing's inertia nor a stuck gear makes contact. It is lost by the force alone: a thrust
  ///        ends in a deceleration whose error pulls the force down (the rotor is heavier than the file says), and to wait for
  ///        certainty there would report lift-off 50 ms late; like this it is within 6 ms in the simulated jumps.
  /// @param dt_s since the last step; a force that is not finite means no contact, at once.
  ContactEstimate step(double vertical_force_N, double force_bound_N, double dt_s) noexcept;

 private:
  ContactParams params_;
  bool contact_ = false;
  double beyond_s_ = 0.0;  ///< how long the force has been beyond the threshold that would change the answer
};

}  // namespace sprung
