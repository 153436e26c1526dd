#pragma once
/// One drive as the bridge sees it: its samples, faults, power and set-points. Reference, mode and what is
/// read in the background have watches of their own. Stepped by time.
#include <cstdint>
#include <memory>

#include "drivers/bridge/background_access.h"
#include "drivers/bridge/bus_node.h"
#include "drivers/bridge/emergency_input.h"
#include "drivers/bridge/host_position_loop.h"
#include "drivers/bridge/impact_watch.h"
#include "drivers/bridge/mode_watch.h"
#include "drivers/bridge/noisy_encoder_watch.h"
#include "drivers/bridge/position_tracker.h"
#include "drivers/bridge/power_control.h"
#include "drivers/bridge/reference_watch.h"
#include "drivers/bridge/setpoint_gate.h"
#include "drivers/bridge/settings_restore.h"
#include "drivers/bridge/stop_watch.h"
#include "drivers/bridge/stuck_encoder_watch.h"
#include "model/winding_watch.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/vec3.h"

namespace sprung {

/// What a drive moves: what its measurements are judged by.
struct DrivePlant {
  double inertia_kg_m2 = 0.0;                             ///< of motor and gear at the output; 0: not known
  PositionRange range;                                    ///< for the drive's own position limits
  double torque_limit_Nm = 0.0, speed_limit_rad_s = 0.0;  ///< also in maintenance mode those of robot.yaml
};

class DriveNode final : public BusNode {
 public:
  DriveNode(const ActuatorConfig& actuator, int index, double cycle_s, const WatchdogConfig& watchdogs,
            const DrivePlant& plant);

  void step(std::int64_t time_us, FrameBatch& out) noexcept override;
  bool receive(const CanFrame& frame, std::int64_t time_us) noexcept override;
  void end_sampling() noexcept override;
  bool fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept override;
  NodeCondition condition() const noexcept override;
  void reset_faults(bool reset) noexcept override;
  void restart() noexcept override;

  void fill(ActuatorState& out) const noexcept;
  bool powered() const noexcept;

  /// Set-points of this cycle by level and command, and the control word when it is due; where a stop is not
  /// obeyed, what stop_watch.h says.
  void emit(std::int64_t time_us, SafetyLevel level, const ActuatorCommand& command,
            FrameBatch& out) noexcept;

  const EmergencyInput& emergency_input() const noexcept { return emergency_input_; }
  const StopWatch& stop() const noexcept { return stop_; }
  void forget_stop() noexcept { stop_.forget(); }

  /// At an orderly end, without power: its settings as they were before us, where robot.yaml asks for that.
  void begin_restore() noexcept;
  bool restored() const noexcept { return !actuator_.restore_settings || restore_.done(); }
  const SettingsRestore& restore() const noexcept { return restore_; }

  /// The last control word may not have gone out.
  void resend_control_word() noexcept { power_.resend(); }

  /// Link side of the gear, from the card, once a cycle after end_sampling(); NaN when there is none in this
  /// cycle.
  void set_link_position(double measured_link_position_rad) noexcept;

  /// Once a cycle after end_sampling(). @param mate_rad encoder_position_rad() of the drive beside it, with
  /// which it swings in one plane.
  void judge_motion(double mate_rad) noexcept;
  void show(GateMotion& out) const noexcept;  ///< of this cycle

  double filtered_velocity_rad_s() const noexcept { return tracker_.filtered_velocity_rad_s(); }
  double measured_link_position_rad() const noexcept { return measured_link_position_rad_; }
  /// What the encoder says, at the output and without offset. Good when answered.
  double encoder_position_rad() const noexcept { return tracker_.position_rad(); }
  std::int64_t encoder_counts() const noexcept;
  const ActuatorConfig& actuator() const noexcept { return actuator_; }

  double temperature_degC() const noexcept { return background_.temperature_degC(); }
  /// Adds what only a drive has to its link's health.
  void show(NodeHealth& out) const noexcept;
  const Reference& reference() const noexcept { return reference_.reference(); }
  void set_reference(const Reference& reference) noexcept { reference_.set(reference); }
  bool has_index() const noexcept { return profile_->index_counter_object().index != 0; }
  /// Reads the encoder's count at its last index pulse, in the background.
  void ask_index() noexcept { background_.ask_index(); }
  IndexAnswer index_answer() const noexcept { return background_.index_answer(); }
  /// As encoder_position_rad(), at the last index pulse; when kKnown.
  double index_position_rad() const noexcept;

 private:
  DriveNode(const ActuatorConfig& actuator, int index, double cycle_s, const WatchdogConfig& watchdogs,
            const DrivePlant& plant, std::unique_ptr<DriveProfile> profile);

  void begin_operation(std::int64_t time_us) noexcept;
  void take_sample(const CanFrame& frame, std::int64_t time_us) noexcept;
  void take_display(const CanFrame& frame) noexcept;
  void accept_sample() noexcept;
  void watch_impacts(std::int64_t sync_us) noexcept;
  bool enabled() const noexcept { return power_state_ == PowerState::kOperationEnabled; }
  bool in_fault() const noexcept;
  bool drive_fault(Fault& out) const noexcept;
  bool supply_fault(Fault& out) const noexcept;
  bool temperature_fault(Fault& out) const noexcept;
  cia402::PowerTarget target(SafetyLevel level, const ActuatorCommand& command) const noexcept;
  DriveSetpoint setpoint(SafetyLevel level, const ActuatorCommand& command) const noexcept;
  DriveMode shown_mode() const noexcept;
  void close_position_loop(DriveSetpoint& setpoint) noexcept;
  void watch_stop(std::int64_t time_us, SafetyLevel level, FrameBatch& out) noexcept;
  void stop_by_sdo(std::int64_t time_us, FrameBatch& out) noexcept;
  double measured_torque_Nm() const noexcept;  ///< by current, output side; NaN before the first sample
  double measured_position_rad() const noexcept { return tracker_.position_rad() + reference().offset_rad; }

  ActuatorConfig actuator_;
  std::unique_ptr<DriveProfile> profile_;  ///< decodes without offset: reference_ holds the one in force
  PowerControl power_;
  PositionTracker tracker_;
  ReferenceWatch reference_;
  ModeWatch modes_;
  BackgroundAccess background_;
  EmergencyInput emergency_input_;
  StopWatch stop_;
  StuckEncoderWatch stuck_;
  NoisyEncoderWatch noise_;
  ImpactWatch impact_;
  HostPositionLoop position_loop_;
  WindingWatch winding_;
  SettingsRestore restore_;
  std::int64_t limited_by_drive_ = 0;  ///< cycles with its status bit "internal limit active"
  double commanded_torque_Nm_ = kNaN;  ///< of the last set-point, in torque control
  bool confirmed_off_ = false;  ///< the last that it said of its power, by an answer to SYNC or to an SDO
  DriveSample sample_;
  std::int64_t received_us_ = 0;
  bool sampled_ = false;
  bool implausible_ = false;  ///< the sample of this cycle
  bool distrusted_ = false;   ///< one was, since the last clear: its velocity damps nothing
  std::int64_t implausible_samples_ = 0;
  double measured_link_position_rad_ = kNaN;
  PowerState power_state_ = PowerState::kUnknown;
};

}  // namespace sprung
