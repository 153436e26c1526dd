#pragma once
/// The robot's battery as the bridge reads it by SDO: voltage, charge, temperature in turn, a round a second.
/// It is told nothing, and nothing in the loop waits for it: one that is silent shows as NaN. Pure; stepped
/// by time.
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_client.h"
#include "robots/robot_config.h"
#include "signals/auxiliary_state.h"

namespace sprung {

class BatteryLink {
 public:
  explicit BatteryLink(const BatteryConfig& config) noexcept;

  bool exists() const noexcept { return config_.bus >= 0; }
  int bus() const noexcept { return config_.bus; }
  int node() const noexcept { return config_.node; }
  /// At most one frame a call. @return true when `out` has to be sent.
  bool step(std::int64_t time_us, CanFrame& out) noexcept;
  void receive(const CanFrame& frame) noexcept { sdo_.receive(frame); }
  /// Fills what is of the battery.
  void show(AuxiliaryState& out) const noexcept;

 private:
  static constexpr std::size_t kReadings = 3;  ///< voltage, charge, temperature
  const ReadingConfig& reading(std::size_t i) const noexcept;
  void take(std::int64_t time_us) noexcept;

  BatteryConfig config_;
  canopen::SdoClient sdo_;
  std::size_t at_ = kReadings;  ///< kReadings: the round is over
  std::int64_t next_round_us_ = 0;
  std::int64_t heard_us_ = 0;
  std::int64_t now_us_ = 0;
  double values_[kReadings];
};

}  // namespace sprung
