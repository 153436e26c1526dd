#pragma once
/// Noise that depends on (seed, signal, cycle) alone: no state, so that leaving a sample out changes no
/// other.
#include <cstdint>

namespace sprung::sim {

/// splitmix64's finaliser: every input bit reaches every output bit (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// Mean 0, rms 1, nearly Gaussian, within 3.47: the sum of four 16-bit uniforms. No libm, so the same bits
/// everywhere.
/// @param signal number of the noise source, unique within a run.
constexpr double hash_noise(std::uint64_t seed, std::uint64_t signal, std::int64_t cycle) noexcept {
  const std::uint64_t bits = mix_bits(mix_bits(mix_bits(seed) ^ signal) ^ static_cast<std::uint64_t>(cycle));
  double sum = 0.0;
  for (int part = 0; part < 4; ++part) {
    sum += (static_cast<double>((bits >> (16 * part)) & 0xFFFF) + 0.5) / 65536.0 - 0.5;
  }
  constexpr double kSqrt3 = 1.7320508075688772;  // each uniform has variance 1/12
  return kSqrt3 * sum;
}

}  // namespace sprung::sim
