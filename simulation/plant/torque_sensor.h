#pragma once
/// A bench's torque sensor between gear and link: slow, noisy, in steps, on a clock of its own. Pure.
#include <array>
#include <cstdint>

#include "signals/sensors.h"

namespace sprung::sim {

struct TorqueSensorConfig {
  int joint = -1;         ///< index into RobotConfig::joints; -1 = there is no sensor
  double rate_Hz = 0.0;   ///< at most one sample a step of the plant
  double noise_Nm = 0.0;  ///< rms
  double resolution_Nm = 0.0;
};

class TorqueSensorDevice {
 public:
  TorqueSensorDevice(const TorqueSensorConfig& config, std::uint64_t seed) noexcept;

  /// Asked once a step of the plant, from cycle 0 on. A reading that is due between two steps is taken at the
  /// later one.
  bool due(std::int64_t running_us) const noexcept;
  void read(const Stamp& stamp, double gear_output_torque_Nm) noexcept;
  std::size_t joint() const noexcept { return static_cast<std::size_t>(config_.joint); }

  static constexpr std::int64_t kKept = 16;
  std::int64_t count() const noexcept { return count_; }
  /// The n-th since cycle 0, of the newest kKept; joint is -1 before the first.
  const TorqueSensor& sample(std::int64_t n) const noexcept {
    return kept_[static_cast<std::size_t>(n) % kept_.size()];
  }

 private:
  double measured_Nm(double torque_Nm) const noexcept;

  TorqueSensorConfig config_;
  std::uint64_t seed_;
  std::array<TorqueSensor, kKept> kept_{};
  std::int64_t count_ = 0;
};

}  // namespace sprung::sim
