#include "simulation/plant/torque_sensor.h"

#include <cmath>

#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

/// Apart from those of drives and link encoders (drive_train.cpp).
constexpr std::uint64_t kTorqueSensorSignal = 1ULL << 34;

}  // namespace

TorqueSensorDevice::TorqueSensorDevice(const TorqueSensorConfig& config, std::uint64_t seed) noexcept
    : config_(config), seed_(seed) {}

bool TorqueSensorDevice::due(std::int64_t running_us) const noexcept {
  return config_.joint >= 0 &&
         static_cast<double>(running_us) * config_.rate_Hz >= 1e6 * static_cast<double>(count_);
}

void TorqueSensorDevice::read(const Stamp& stamp, double gear_output_torque_Nm) noexcept {
  kept_[static_cast<std::size_t>(count_) % kept_.size()] = {stamp, config_.joint,
                                                            measured_Nm(gear_output_torque_Nm)};
  ++count_;
}

double TorqueSensorDevice::measured_Nm(double torque_Nm) const noexcept {
  const double noisy_Nm = torque_Nm + config_.noise_Nm * hash_noise(seed_, kTorqueSensorSignal, count_);
  if (config_.resolution_Nm <= 0.0) return noisy_Nm;
  return std::round(noisy_Nm / config_.resolution_Nm) * config_.resolution_Nm;
}

}  // namespace sprung::sim
