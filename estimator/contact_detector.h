#pragma once
/// Is the foot on the ground? From the external torques of its joints and from what is known to be wrong with
/// them, with hysteresis and separate rise and fall delays in message time; never from a clock or a phase.
/// Pure.
///
/// Each joint's residual model (residual_model.h) takes off the error that the swing has shown and gives the
/// variance of what is left. The vertical force that explains the joints best is F = sum(lever y / var) /
/// sum(lever^2 / var), its standard deviation sqrt(1 / sum(lever^2 / var)): a joint that reverses, or that a
/// vertical force does not load, counts little. Contact is declared above max(on, kSure standard deviations)
/// and lost below `off`.
///
/// A foot that lands while its trunk moves is also pushed along the floor, and at a hip that force outweighs
/// the vertical one: it has the longer lever. With `tangential_N` the two forces along the floor are unknowns
/// of the same least squares, expected to be zero give or take so much. They change how the joints are
/// weighed, not how sure the answer must be: a foot in the air has no such forces.
#include <array>
#include <vector>

#include "estimator/residual_model.h"

namespace sprung {

struct ContactParams {
  double on_N = 0.0;    ///< contact is declared above this, > off_N
  double off_N = 0.0;   ///< and lost below this
  double rise_s = 0.0;  ///< must last this long, >= 0
  double fall_s = 0.0;
  double tangential_N = 0.0;  ///< one standard deviation of a force along the floor, >= 0; 0: there is none
};

/// One joint of the leg in this cycle.
struct ContactEvidence {
  JointResidual residual;
  double lever_m = 0.0;  ///< torque of a vertical force of 1 N on the foot: its row of the Jacobian
  std::array<double, 2> tangential_lever_m{};  ///< the same of forces along the floor, x and y
};

struct [[nodiscard]] ContactEstimate {
  bool contact = false;
  double confidence = 0.0;  ///< that the foot is on the ground: 0.5 between the thresholds, 0 when nothing is
                            ///< known
  double force_N = 0.0;     ///< vertical, as above
  double force_std_N = 0.0;
};

class ContactDetector {
 public:
  /// @param joints what is known to be wrong with each, and how noisy it is.
  /// @throws std::invalid_argument unless on > off and neither a delay nor the tangential force is negative.
  ContactDetector(const ContactParams& params, std::vector<ResidualModel> joints);
  void reset() noexcept;
  /// Nothing has touched the foot for some time: what moves its joints then is the drives and errors.
  bool surely_free() const noexcept;
  double free_s() const noexcept { return free_s_; }  ///< since contact was lost; 0 in contact
  /// @param evidence one for each joint; numbers that are not finite mean no contact, at once.
  /// @param dt_s since the last step.
  ContactEstimate step(const std::vector<ContactEvidence>& evidence, double dt_s) noexcept;

 private:
  struct Force {
    double value_N = 0.0;
    double model_N2 = 0.0, noise_N2 = 0.0, rest_N2 = 0.0;  ///< variances, as of ResidualModel
  };
  Force force(const std::vector<ContactEvidence>& evidence) const noexcept;
  /// Forces along the floor (x, y) that look like a vertical one of 1 N to the joints.
  std::array<double, 2> tangential_look_alike(const std::vector<ContactEvidence>& evidence) const noexcept;
  double least_rise_N(const Force& force) const noexcept;
  double least_hold_N(const Force& force) const noexcept;
  void decide(const Force& force, double dt_s) noexcept;

  ContactParams params_;
  std::vector<ResidualModel> joints_;
  bool contact_ = false;
  double free_s_ = 0.0;    ///< since contact was lost
  double beyond_s_ = 0.0;  ///< how long the force has been beyond the threshold that would change the answer;
                           ///< for a loss, less how long it has not
};

}  // namespace sprung
