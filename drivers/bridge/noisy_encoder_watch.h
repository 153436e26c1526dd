#pragma once
/// A motor encoder whose count jitters by more than its joint can: each sample may follow the one before, but
/// together they ask for accelerations that no torque gives. Velocity from it is worthless, and damping by it
/// drives (hazard 7). Noisy: in a window of 20 ms a third of the second differences, and at least four, are
/// beyond eight times what the torque limit gives the motor's own inertia. An impact is over sooner: it is
/// one or two. Pure; once a sample.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sprung {

class NoisyEncoderWatch {
 public:
  /// @param torque_limit_Nm, inertia_kg_m2 of the actuator, output side; inertia 0: not known, nothing is
  /// watched. @param quantum_rad of the position: rounding alone is no noise.
  NoisyEncoderWatch(double torque_limit_Nm, double inertia_kg_m2, double quantum_rad,
                    double cycle_s) noexcept;

  /// @param answers the SYNC of `sync_us`; a gap begins anew.
  void add(double position_rad, std::int64_t sync_us) noexcept;
  bool noisy() const noexcept { return noisy_; }
  /// Root mean square of the jitter, by the second differences of the window.
  double noise_rad() const noexcept;
  void forget() noexcept;

 private:
  static constexpr std::size_t kMost = 20;  ///< samples in the window, at 1 kHz

  void judge(double difference_rad) noexcept;
  bool is_jitter(double difference_rad) const noexcept { return std::abs(difference_rad) > most_rad_; }

  double most_rad_;     ///< of a second difference that is no jitter; 0: nothing is watched
  std::size_t window_;  ///< samples
  std::int64_t cycle_us_;
  std::array<double, 2> before_rad_{};  ///< the last, and the one before it
  std::int64_t last_us_ = 0;
  int known_ = 0;                           ///< of before_rad_
  std::array<double, kMost> difference_{};  ///< second differences, a ring
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
  std::size_t beyond_ = 0;  ///< of those in the ring
  bool noisy_ = false;
};

}  // namespace sprung
