#pragma once
/// One drive as the bridge sees it: boot, samples, faults, heartbeat watch, supply voltage, power. Stepped by
/// time.
#include <cstdint>
#include <memory>

#include "drivers/bridge/node_boot.h"
#include "drivers/bridge/position_tracker.h"
#include "drivers/bridge/power_control.h"
#include "drivers/bridge/safety_machine.h"
#include "drivers/profiles/drive_profile.h"
#include "signals/signals.h"

namespace sprung {

class DriveNode {
 public:
  DriveNode(const ActuatorConfig& actuator, double cycle_s, const WatchdogConfig& watchdogs);

  /// Boot frames, then background reads; at most one frame.
  void step(std::int64_t time_us, FrameBatch& out) noexcept;
  void receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  void begin_sampling(std::int64_t sync_us) noexcept;
  /// Counts an unanswered SYNC.
  void end_sampling() noexcept;
  void fill(ActuatorState& out) const noexcept;

  /// What is wrong with a drive that should be running. @return false when nothing is; `out` is then
  /// untouched.
  bool trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept;
  /// Set-points of this cycle by level and command, and the control word when it is due.
  void emit(std::int64_t time_us, SafetyLevel level, const ActuatorCommand& command,
            FrameBatch& out) noexcept;

  /// Faults have been judged: one that the drive has withdrawn may now be forgotten.
  void faults_seen() noexcept { emergency_seen_ = true; }
  /// Fault-reset edges until the fault is gone.
  void reset_faults(bool reset) noexcept;
  void restart() noexcept;
  void start() noexcept { boot_.start(); }

  const NodeBoot& boot() const noexcept { return boot_; }
  bool answered() const noexcept { return answered_; }
  bool silent() const noexcept { return age_cycles_ > watchdogs_.silent_cycles; }
  bool lost(std::int64_t time_us) const noexcept;  ///< not operational any more, or no heartbeat
  bool faulted() const noexcept;
  bool powered() const noexcept;
  double filtered_velocity_rad_s() const noexcept { return tracker_.filtered_velocity_rad_s(); }
  const ActuatorConfig& actuator() const noexcept { return actuator_; }

 private:
  void receive_heartbeat(const CanFrame& frame, std::int64_t time_us) noexcept;
  void receive_emergency(const CanFrame& frame) noexcept;
  void receive_process_data(const CanFrame& frame, std::int64_t time_us) noexcept;
  bool step_supply(std::int64_t time_us, CanFrame& out) noexcept;
  cia402::PowerTarget target(SafetyLevel level, const ActuatorCommand& command) const noexcept;
  DriveSetpoint setpoint(SafetyLevel level, const ActuatorCommand& command) const noexcept;

  ActuatorConfig actuator_;
  WatchdogConfig watchdogs_;
  std::unique_ptr<DriveProfile> profile_;
  canopen::SdoClient sdo_;
  NodeBoot boot_;
  PowerControl power_;
  PositionTracker tracker_;
  DriveSample sample_;
  bool sampled_ = false;
  bool answered_ = false;
  bool implausible_ = false;
  int age_cycles_ = 0;
  std::int64_t sync_us_ = 0;
  std::int8_t mode_display_ = 0;
  bool mode_display_known_ = false;  ///< by TPDO since the last boot; else as read while booting
  DriveMode sent_mode_ = DriveMode::kTorque;
  PowerState power_state_ = PowerState::kUnknown;
  canopen::Emergency emergency_;
  bool emergency_seen_ = false;       ///< by faults_seen()
  bool emergency_withdrawn_ = false;  ///< forgotten by the next begin_sampling() after it was seen
  canopen::NmtState nmt_state_ = canopen::NmtState::kUnknown;
  std::int64_t heartbeat_us_ = 0;
  std::int64_t next_supply_us_ = 0;
  double measured_supply_V_ = kNaN;
};

}  // namespace sprung
