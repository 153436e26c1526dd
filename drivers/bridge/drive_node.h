#pragma once
/// One drive as the bridge sees it: what NodeLink does for every node, and samples, faults, power, modes,
/// supply voltage and the reference of its position. Stepped by time.
#include <cstdint>
#include <memory>

#include "drivers/bridge/bridge_core.h"
#include "drivers/bridge/node_link.h"
#include "drivers/bridge/position_tracker.h"
#include "drivers/bridge/power_control.h"
#include "signals/bus_state.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/vec3.h"

namespace sprung {

/// Answer to DriveNode::ask_index().
enum class IndexAnswer : std::int8_t { kNone, kWaiting, kKnown, kFailed };

class DriveNode final : public NodeLink {
 public:
  DriveNode(const ActuatorConfig& actuator, int index, double cycle_s, const WatchdogConfig& watchdogs);

  void fill(ActuatorState& out) const noexcept;
  bool trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept override;
  bool faulted() const noexcept override;
  bool powered() const noexcept override;
  void reset_faults(bool reset) noexcept override;
  void restart() noexcept override;
  NodeHealth health() const noexcept override;

  /// Set-points of this cycle by level and command, and the control word when it is due.
  void emit(std::int64_t time_us, SafetyLevel level, const ActuatorCommand& command,
            FrameBatch& out) noexcept;

  /// The last control word may not have gone out.
  void resend_control_word() noexcept { power_.resend(); }

  /// Link side of the gear, from the card, once a cycle after end_sampling(); NaN when there is none in this
  /// cycle.
  void set_link_position(double measured_link_position_rad) noexcept;

  double filtered_velocity_rad_s() const noexcept { return tracker_.filtered_velocity_rad_s(); }
  double measured_link_position_rad() const noexcept { return measured_link_position_rad_; }
  /// What the encoder says, at the output and without offset. Good when answered().
  double encoder_position_rad() const noexcept { return tracker_.position_rad(); }
  std::int64_t encoder_counts() const noexcept;
  const ActuatorConfig& actuator() const noexcept { return actuator_; }

  const Reference& reference() const noexcept { return reference_; }
  void set_reference(const Reference& reference) noexcept;
  bool has_index() const noexcept { return profile_->index_counter_object().index != 0; }
  /// Reads the encoder's count at its last index pulse, in the background.
  void ask_index() noexcept { index_answer_ = IndexAnswer::kWaiting; }
  IndexAnswer index_answer() const noexcept { return index_answer_; }
  /// As encoder_position_rad(), at the last index pulse; when kKnown.
  double index_position_rad() const noexcept { return index_position_rad_; }

 protected:
  void take_sample(const CanFrame& frame, std::int64_t time_us) noexcept override;
  bool accept_sample() noexcept override;
  void take_other(const CanFrame& frame) noexcept override;
  void on_operational(std::int64_t time_us) noexcept override;
  void on_possible_restart() noexcept override { doubt_reference(); }
  const char* note() const noexcept override { return reference_loss_; }
  bool step_background(std::int64_t time_us, canopen::SdoClient& sdo, CanFrame& out) noexcept override;

 private:
  DriveNode(const ActuatorConfig& actuator, int index, const WatchdogConfig& watchdogs,
            std::unique_ptr<DriveProfile> profile);

  enum class Reading : std::int8_t { kNothing, kSupply, kMode, kIndex };

  void take_reading(canopen::SdoClient& sdo) noexcept;
  Reading next_reading(std::int64_t time_us) noexcept;
  canopen::ObjectId object_of(Reading reading) const noexcept;
  void doubt_reference() noexcept;
  void lose_reference(const char* why) noexcept;
  bool mode_confirmed() const noexcept;
  bool own_trouble(Trouble& out) const noexcept;
  cia402::PowerTarget target(SafetyLevel level, const ActuatorCommand& command) const noexcept;
  DriveSetpoint setpoint(SafetyLevel level, const ActuatorCommand& command) const noexcept;
  double measured_position_rad() const noexcept { return tracker_.position_rad() + reference_.offset_rad; }

  ActuatorConfig actuator_;
  std::unique_ptr<DriveProfile> profile_;  ///< decodes without offset: reference_ holds the one in force
  PowerControl power_;
  PositionTracker tracker_;
  Reference reference_;
  const char* reference_loss_ = "";  ///< static text; "" since it was found
  DriveSample sample_;
  std::int64_t received_us_ = 0;
  bool sampled_ = false;
  bool implausible_ = false;  ///< the sample of this cycle
  double measured_link_position_rad_ = kNaN;
  int cycles_apart_ = 0;  ///< motor and link encoder disagree for so many cycles
  bool apart_ = false;    ///< they disagreed for too long; until the reference is found anew

  std::int8_t mode_display_ = 0;
  bool mode_display_known_ = false;  ///< by TPDO since the last boot; else as read while booting
  DriveMode sent_mode_ = DriveMode::kTorque;
  std::int64_t unconfirmed_us_ = 0;  ///< how long the drive has not shown the mode that it was told
  std::int64_t confirmed_at_us_ = 0;
  std::int64_t next_mode_read_us_ = 0;
  PowerState power_state_ = PowerState::kUnknown;

  Reading reading_ = Reading::kNothing;
  std::int64_t next_supply_us_ = 0;
  double measured_supply_V_ = kNaN;
  IndexAnswer index_answer_ = IndexAnswer::kNone;
  double index_position_rad_ = 0.0;
};

}  // namespace sprung
