#include "drivers/profiles/encoder_card/encoder_card_device.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"
#include "simulation/device_registry.h"
#include "simulation/hash_noise.h"
#include "sprung_embedded/encoder_card_eds_extra_text.h"
#include "sprung_embedded/encoder_card_eds_text.h"

namespace sprung::encoder_card {
namespace {

constexpr canopen::ObjectId kSampleObject{0x2100, 0};
constexpr std::uint16_t kEncoders = 0x2101;  ///< :01.. each channel's counts
/// Noise of cards is numbered apart from that of drives.
constexpr std::uint64_t kCardSignals = 0x10000;

std::array<std::int64_t, kChannels> counts_per_turn(const sim::SimCardSetup& setup) {
  std::array<std::int64_t, kChannels> counts;
  counts.fill(kCountsPerTurn);
  for (std::size_t i = 0; i < std::min(kChannels, setup.counts_per_turn.size()); ++i) {
    const std::int64_t wanted = std::llround(setup.counts_per_turn[i]);
    if (wanted > 0 && wanted <= kCountsPerTurn) counts[i] = wanted;
  }
  return counts;
}

std::uint64_t noise_signal(const EncoderCardConfig& card) noexcept {
  return kCardSignals +
         static_cast<std::uint64_t>(card.bus * (canopen::kMaxNode + 1) + card.node) * kChannels;
}

}  // namespace

EncoderCardDevice::EncoderCardDevice(const sim::SimCardSetup& setup)
    : SimCard(setup.card.bus),
      seed_(setup.seed),
      signal_(noise_signal(setup.card)),
      counts_per_turn_(counts_per_turn(setup)),
      dictionary_(canopen::parse_eds(encoder_card_eds_text(), "encoder_card.eds", setup.card.node,
                                     encoder_card_eds_extra_text())),
      device_(setup.card.node, dictionary_, *this, outbox()) {}

void EncoderCardDevice::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (on_) device_.receive(frame, time_us);
}

void EncoderCardDevice::step(std::int64_t time_us) noexcept {
  on_ ? device_.tick(time_us) : outbox().release(time_us);
}

/// Absolute within a turn, so that an angle below 0 counts down from the top.
std::uint32_t EncoderCardDevice::counts(int channel, double link_rad, std::int64_t cycle) const noexcept {
  const std::uint64_t signal = signal_ + static_cast<std::uint64_t>(channel);
  const double noise_rad = noise_rad_ == 0.0 ? 0.0 : noise_rad_ * sim::hash_noise(seed_, signal, cycle);
  const double turns = (link_rad + jumped_rad_ + noise_rad) / kTurn_rad;
  const std::int64_t steps = counts_per_turn_[channel];
  const std::int64_t count = std::llround(std::floor(turns * static_cast<double>(steps))) % steps;
  return static_cast<std::uint32_t>(count < 0 ? count + steps : count);
}

void EncoderCardDevice::sample(int channel, double link_rad, std::int64_t cycle) noexcept {
  if (channel < 0 || channel >= static_cast<int>(kChannels) || stuck_) return;
  seen_[channel] = counts(channel, link_rad, cycle);
}

/// The SYNC latches all channels at one instant.
void EncoderCardDevice::synced() noexcept {
  latched_.counts = seen_;
  latched_.counter = static_cast<std::uint8_t>((latched_.counter + 1) & kCounterMask);
  show();
}

void EncoderCardDevice::show() noexcept {
  dictionary_.set(kSampleObject, static_cast<std::int64_t>(pack(latched_)));
  for (std::size_t i = 0; i < kChannels; ++i)
    dictionary_.set({kEncoders, static_cast<std::uint8_t>(i + 1)}, latched_.counts[i]);
}

void EncoderCardDevice::set_fault(FaultKind kind, double value, bool on) noexcept {
  switch (kind) {
    case FaultKind::kEncoderStuck:
      stuck_ = on;
      return;
    case FaultKind::kEncoderJump:
      if (on) jumped_rad_ += value;
      return;
    case FaultKind::kEncoderNoise:
      noise_rad_ = on ? value : 0.0;
      return;
    case FaultKind::kPowerCycle:
      return switch_power(!on);
    default:
      return;
  }
}

/// What an absolute encoder had jumped, power brings back.
void EncoderCardDevice::switch_power(bool on) noexcept {
  on_ = on;
  if (!on) return;
  jumped_rad_ = 0.0;
  device_.power_cycle();
}

}  // namespace sprung::encoder_card

namespace sprung::profiles {

extern const sim::DeviceKind encoder_card_device_kind{
    "encoder_card", nullptr, [](const sim::SimCardSetup& setup) -> std::unique_ptr<sim::SimCard> {
      return std::make_unique<encoder_card::EncoderCardDevice>(setup);
    }};

}  // namespace sprung::profiles
