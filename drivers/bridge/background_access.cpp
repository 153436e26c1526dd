#include "drivers/bridge/background_access.h"

#include <utility>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

using canopen::SdoStatus;

constexpr std::int64_t kInputsPeriod_us = 100'000;
constexpr std::int64_t kSupplyPeriod_us = 1'000'000;
constexpr std::int64_t kTemperaturePeriod_us = 1'000'000;
constexpr std::int64_t kSupplyStagger_us = 20'000;  // a node: not all drives ask the bus in one cycle
// [design choice] a TPDO2 that was lost is asked for after this; drives switch within milliseconds
constexpr std::int64_t kModeRead_us = 50'000;

}  // namespace

void BackgroundAccess::begin_operation(int node, std::int64_t time_us) noexcept {
  reading_ = Reading::kNothing;
  next_inputs_us_ = time_us;
  next_supply_us_ = time_us + kSupplyStagger_us * node;
  next_temperature_us_ = next_supply_us_ + kTemperaturePeriod_us / 2;
}

bool BackgroundAccess::step(std::int64_t time_us, canopen::SdoClient& sdo, std::int64_t unconfirmed_us,
                            CanFrame& out) noexcept {
  if (sdo.status() != SdoStatus::kBusy) {
    take(sdo);
    reading_ = next(time_us, unconfirmed_us);
    if (reading_ == Reading::kNothing) return false;
    ask(sdo);
  }
  return sdo.step(time_us, out);
}

void BackgroundAccess::ask(canopen::SdoClient& sdo) const noexcept {
  const auto limit = reading_ == Reading::kLimits ? position_limits_.next() : std::nullopt;
  if (limit && limit->write) return sdo.write(limit->object, limit->value, 4);
  sdo.read(limit ? limit->object : object_of(reading_));
}

/// A refusal or a time-out leaves the last value.
void BackgroundAccess::take(canopen::SdoClient& sdo) noexcept {
  const bool good = sdo.status() == SdoStatus::kDone;
  if (!good && sdo.status() != SdoStatus::kIdle) ++failures_;
  if (reading_ == Reading::kLimits) position_limits_.took(good, sdo.value());
  if (reading_ == Reading::kSupply && good) measured_supply_V_ = profile_.supply_V(sdo.value());
  if (reading_ == Reading::kTemperature && good) measured_temperature_degC_ = temperature_.value(sdo.value());
  if (reading_ == Reading::kInputs && good) levels_ = sdo.value();
  if (reading_ == Reading::kMode && good) mode_ = static_cast<std::int8_t>(sdo.value() & 0xFF);
  if (reading_ == Reading::kIndex) {
    // Until an index pulse has been passed the count is 0 [U].
    index_answer_ = good && sdo.value() != 0 ? IndexAnswer::kKnown : IndexAnswer::kFailed;
    index_counts_ = static_cast<std::int32_t>(sdo.value());
  }
  reading_ = Reading::kNothing;
  sdo.finish();
}

BackgroundAccess::Reading BackgroundAccess::next(std::int64_t time_us, std::int64_t unconfirmed_us) noexcept {
  if (inputs_ && time_us >= next_inputs_us_) {
    next_inputs_us_ = time_us + kInputsPeriod_us;
    return Reading::kInputs;
  }
  if (index_answer_ == IndexAnswer::kWaiting) return Reading::kIndex;
  if (position_limits_.next()) return Reading::kLimits;
  if (unconfirmed_us > kModeRead_us && time_us >= next_mode_us_) {
    next_mode_us_ = time_us + kModeRead_us;
    return Reading::kMode;
  }
  if (temperature_.index != 0 && time_us >= next_temperature_us_) {
    next_temperature_us_ = time_us + kTemperaturePeriod_us;
    return Reading::kTemperature;
  }
  if (time_us < next_supply_us_ || profile_.supply_voltage_object().index == 0) return Reading::kNothing;
  next_supply_us_ = time_us + kSupplyPeriod_us;
  return Reading::kSupply;
}

canopen::ObjectId BackgroundAccess::object_of(Reading reading) const noexcept {
  if (reading == Reading::kInputs) return profile_.inputs().object;
  if (reading == Reading::kMode) return {canopen::kModeDisplay, 0};
  if (reading == Reading::kTemperature) return {temperature_.index, temperature_.sub};
  return reading == Reading::kIndex ? profile_.index_counter_object() : profile_.supply_voltage_object();
}

std::optional<std::uint32_t> BackgroundAccess::take_inputs() noexcept {
  return std::exchange(levels_, std::nullopt);
}

std::optional<std::int8_t> BackgroundAccess::take_mode() noexcept {
  return std::exchange(mode_, std::nullopt);
}

}  // namespace sprung
