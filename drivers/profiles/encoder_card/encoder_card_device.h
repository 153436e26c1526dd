#pragma once
/// A simulated encoder card: three absolute 20-bit encoders on the link side of gears, read at every SYNC and
/// sent as one PDO (encoder_card_layout.h). No power stage: a fault is an emergency and nothing more. What a
/// real card does is [unverified].
#include <array>
#include <cstdint>

#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "simulation/node/canopen_device.h"
#include "simulation/node/sim_device.h"

namespace sprung::encoder_card {

class EncoderCardDevice final : public sim::SimCard, private sim::DeviceApplication {
 public:
  explicit EncoderCardDevice(const sim::SimCardSetup& setup);

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept override;
  void sample(int channel, double link_rad, std::int64_t cycle) noexcept override;
  void step(std::int64_t time_us) noexcept override;
  bool operational() const noexcept override { return on_ && device_.operational(); }
  /// Encoder faults hit every channel; kPowerCycle takes the supply until the fault ends.
  void set_fault(FaultKind kind, double value, bool on) noexcept override;
  void raise_fault(std::uint16_t code) noexcept override { device_.raise(code); }

 private:
  void synced() noexcept override;
  void written(canopen::ObjectId /*id*/) noexcept override {}
  void connection_lost() noexcept override {}
  void connection_back() noexcept override { device_.clear_errors(); }
  void reset() noexcept override { latched_ = {}; }

  void switch_power(bool on) noexcept;
  void show() noexcept;
  std::uint32_t counts(int channel, double link_rad, std::int64_t cycle) const noexcept;

  std::uint64_t seed_;
  std::uint64_t signal_;  ///< of the first channel's noise on demand
  std::array<std::int64_t, kChannels> counts_per_turn_;
  sim::ObjectDictionary dictionary_;
  sim::CanopenDevice device_;
  std::array<std::uint32_t, kChannels> seen_{};  ///< counts that the next SYNC latches
  Sample latched_;
  bool on_ = true;
  bool stuck_ = false;
  double jumped_rad_ = 0.0;
  double noise_rad_ = 0.0;  ///< rms
};

}  // namespace sprung::encoder_card
