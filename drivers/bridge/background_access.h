#pragma once
/// What is read from a drive beside its cycle, one object at a time: its inputs ten times a second where one
/// is an emergency stop's, its supply voltage once a second, its mode where it does not show the one that it
/// was told, and the count of its encoder at the last index; and its position limits, which are written
/// first. Stepped by time.
#include <cstdint>
#include <optional>

#include "drivers/bridge/drive_position_limits.h"
#include "drivers/canopen/sdo_client.h"
#include "drivers/profiles/drive_profile.h"
#include "signals/bus_state.h"
#include "signals/vec3.h"

namespace sprung {

/// Answer to BackgroundAccess::ask_index().
enum class IndexAnswer : std::int8_t { kNone, kWaiting, kKnown, kFailed };

class BackgroundAccess {
 public:
  /// @param profile of the drive, which outlives this.
  /// @param temperature where the drive shows one; index 0: it does not.
  BackgroundAccess(const DriveProfile& profile, bool inputs,
                   const DrivePositionLimits& position_limits = {0, {}, 1.0},
                   const ReadingConfig& temperature = {}) noexcept
      : profile_(profile), inputs_(inputs), position_limits_(position_limits), temperature_(temperature) {}

  /// The drive is in operation; what was being read is forgotten.
  void begin_operation(int node, std::int64_t time_us) noexcept;
  /// @param sdo of the node, free for this while it is in operation. @param unconfirmed_us as ModeWatch.
  /// @return whether `out` has to be sent.
  bool step(std::int64_t time_us, canopen::SdoClient& sdo, std::int64_t unconfirmed_us,
            CanFrame& out) noexcept;

  DrivePositionLimits& position_limits() noexcept { return position_limits_; }
  const DrivePositionLimits& position_limits() const noexcept { return position_limits_; }
  double supply_V() const noexcept { return measured_supply_V_; }  ///< NaN until it was read
  /// NaN until it was read, and where there is none.
  double temperature_degC() const noexcept { return measured_temperature_degC_; }
  /// The mode display that was read since the last call.
  std::optional<std::int8_t> take_mode() noexcept;

  /// The levels of the inputs that were read since the last call.
  std::optional<std::uint32_t> take_inputs() noexcept;

  void ask_index() noexcept { index_answer_ = IndexAnswer::kWaiting; }
  IndexAnswer index_answer() const noexcept { return index_answer_; }
  std::int32_t index_counts() const noexcept { return index_counts_; }  ///< when kKnown
  /// Adds what was refused or not answered to the node's SDO failures.
  void show(NodeHealth& out) const noexcept { out.sdo_failures += failures_; }

 private:
  enum class Reading : std::int8_t { kNothing, kInputs, kLimits, kSupply, kMode, kIndex, kTemperature };

  void take(canopen::SdoClient& sdo) noexcept;
  Reading next(std::int64_t time_us, std::int64_t unconfirmed_us) noexcept;
  void ask(canopen::SdoClient& sdo) const noexcept;
  canopen::ObjectId object_of(Reading reading) const noexcept;

  const DriveProfile& profile_;
  bool inputs_;
  DrivePositionLimits position_limits_;
  ReadingConfig temperature_;
  Reading reading_ = Reading::kNothing;
  std::int64_t next_supply_us_ = 0;
  std::int64_t next_temperature_us_ = 0;
  std::int64_t next_mode_us_ = 0;
  std::int64_t next_inputs_us_ = 0;
  std::optional<std::uint32_t> levels_;
  double measured_supply_V_ = kNaN;
  double measured_temperature_degC_ = kNaN;
  std::optional<std::int8_t> mode_;
  IndexAnswer index_answer_ = IndexAnswer::kNone;
  std::int32_t index_counts_ = 0;
  std::int64_t failures_ = 0;
};

}  // namespace sprung
