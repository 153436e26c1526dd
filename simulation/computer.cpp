#include "simulation/computer.h"

#include <cmath>

#include "simulation/hash_noise.h"

namespace sprung::sim {

namespace {

/// Apart from every noise source (drive_train.cpp, imu_sensor.cpp, torque_sensor.cpp).
constexpr std::uint64_t kTailSignal = 1ULL << 36;
constexpr std::uint64_t kMissSignal = kTailSignal + 1;

}  // namespace

Computer::Computer(const TimingConfig& timing, std::uint64_t seed) noexcept
    : seed_(seed),
      compute_us_(std::llround(1e6 * timing.compute_s)),
      tail_us_(1e6 * timing.compute_tail_s),
      missed_(timing.missed_cycles) {}

std::int64_t Computer::compute_us(std::int64_t cycle) const noexcept {
  if (tail_us_ <= 0.0 || cycle < 0) return compute_us_;
  // Roots that IEEE 754 rounds exactly: the same bits everywhere.
  const double root = std::sqrt(std::sqrt(uniform(kTailSignal, cycle)));
  return compute_us_ + std::llround(3.0 * tail_us_ * (1.0 / root - 1.0));
}

bool Computer::misses(std::int64_t cycle) const noexcept {
  return missed_ > 0.0 && cycle >= 0 && uniform(kMissSignal, cycle) < missed_;
}

/// 53 bits, so that it is never 0.
double Computer::uniform(std::uint64_t signal, std::int64_t cycle) const noexcept {
  const std::uint64_t bits = mix_bits(mix_bits(mix_bits(seed_) ^ signal) ^ static_cast<std::uint64_t>(cycle));
  return (static_cast<double>(bits >> 11) + 0.5) / 9007199254740992.0;
}

}  // namespace sprung::sim
