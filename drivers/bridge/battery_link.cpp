#include "drivers/bridge/battery_link.h"

#include <algorithm>
#include <iterator>

namespace sprung {
namespace {

// [design choice] Nothing about a battery is urgent.
constexpr std::int64_t kRound_us = 1'000'000;
constexpr std::int64_t kAnswer_us = 100'000;
constexpr std::int64_t kSilent_us = 3'000'000;

}  // namespace

BatteryLink::BatteryLink(const BatteryConfig& config) noexcept
    : config_(config), sdo_(config.node, kAnswer_us) {
  std::fill(std::begin(values_), std::end(values_), kNaN);
}

const ReadingConfig& BatteryLink::reading(std::size_t i) const noexcept {
  return i == 0 ? config_.voltage : i == 1 ? config_.charge : config_.temperature;
}

/// What is refused or not answered leaves the last value, until the battery counts as silent.
void BatteryLink::take(std::int64_t time_us) noexcept {
  if (sdo_.status() == canopen::SdoStatus::kDone) {
    values_[at_] = reading(at_).value(sdo_.value());
    heard_us_ = time_us;
  }
  sdo_.finish();
  ++at_;
}

bool BatteryLink::step(std::int64_t time_us, CanFrame& out) noexcept {
  now_us_ = time_us;
  if (!exists()) return false;
  if (at_ < kReadings && sdo_.status() != canopen::SdoStatus::kBusy) take(time_us);
  if (at_ == kReadings) {
    if (time_us < next_round_us_) return false;
    next_round_us_ = time_us + kRound_us;
    at_ = 0;
  }
  if (sdo_.idle()) sdo_.read({reading(at_).index, reading(at_).sub});
  return sdo_.step(time_us, out);
}

void BatteryLink::show(AuxiliaryState& out) const noexcept {
  const bool silent = now_us_ - heard_us_ > kSilent_us;
  out.battery_voltage_V = silent ? kNaN : values_[0];
  out.battery_charge_share = silent ? kNaN : values_[1];
  out.battery_temperature_degC = silent ? kNaN : values_[2];
}

}  // namespace sprung
