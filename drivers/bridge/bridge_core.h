#pragma once
/// The CAN drive bridge without its process: frames and a time in, frames and a status out. Boot, SDO client,
/// heartbeat and safety are state machines stepped by time; no thread, clock, socket, log or allocation after
/// construction.
///
/// One tick, whatever the clock:
///   begin_tick(t, out)   NMT, SDO, heartbeat frames that are due, then SYNC last on every bus
///   receive(bus, f, t)   for every frame that comes in, at any time
///   all_answered()       every operational drive has answered this SYNC, and older ones first if it owed
///                        them (else the shell waits until its deadline)
///   end_sampling(t, s)   true once cyclic operation began: s is DRIVE_STATE(k), k counts from 0
///   command(c, t)        DRIVE_COMMAND(k) came in: checked, stored, or refused and counted
///   emit_setpoints(t, o) RPDOs of this cycle: the command if it is good, else what safety says
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/bridge/bus_monitor.h"
#include "drivers/can/can_frame.h"
#include "robots/robot_config.h"
#include "signals/auxiliary_state.h"
#include "signals/bus_state.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"

namespace sprung {

/// Zero of an actuator: actuator position = what the motor encoder says, at the output + offset.
struct Reference {
  double offset_rad = 0.0;
  bool known = false;
  ReferenceSource source = ReferenceSource::kConfigured;
};

struct BridgeOptions {
  WatchdogConfig watchdogs;  ///< which set of robot.yaml applies
};

class BridgeCore {
 public:
  /// @throws std::invalid_argument on an unknown profile, naming it and those there are, and on a channel
  /// that an encoder card has not.
  BridgeCore(const RobotConfig& robot, const BridgeOptions& options);
  ~BridgeCore();
  BridgeCore(const BridgeCore&) = delete;
  BridgeCore& operator=(const BridgeCore&) = delete;

  void begin_tick(std::int64_t time_us, FrameBatch& out) noexcept;
  void receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept;
  bool all_answered() const noexcept;
  /// @return false while booting: then there is no cycle, no DRIVE_STATE and nothing to command.
  bool end_sampling(std::int64_t time_us, DriveState& out) noexcept;
  /// Refuses what is not finite, out of limits, not of this cycle's size, older than what it has, or expired.
  bool command(const DriveCommand& command, std::int64_t time_us) noexcept;
  void emit_setpoints(std::int64_t time_us, FrameBatch& out) noexcept;

  /// Estop acts at once. Clear and home are accepted or refused, and answered again by next_reply() when they
  /// are done or have failed; a request that comes twice gets its last answer. Others are not the bridge's.
  OperatorReply operator_command(const OperatorCommand& command, std::int64_t time_us) noexcept;
  /// Answers that have become due by themselves. @return false when there is none.
  bool next_reply(OperatorReply& out) noexcept;
  /// Frames of this cycle did not go out; they are not repeated, newer ones follow.
  void send_failed(int bus, SendFailure failure, std::int64_t time_us) noexcept;
  /// What the CAN back end has counted, for bus_state(). Leave it out where it depends on the wall clock.
  void set_traffic(int bus, const BusTraffic& traffic) noexcept;
  /// A zero that was found earlier and is still good; before cyclic operation.
  void restore_reference(int actuator, const Reference& reference) noexcept;
  const Reference& reference(int actuator) const noexcept;
  std::int64_t encoder_counts(int actuator) const noexcept;  ///< of the last sample, for the record
  std::int64_t homings() const noexcept;                     ///< that were done
  /// Shell's own counters, for the safety rules on overruns and for SAFETY_STATE.
  void count_overrun(std::int64_t time_us) noexcept;
  void count_good_cycle() noexcept;
  void count_missed_cycle() noexcept;
  /// Orderly end: damping until slow for 0.3 s, at most 1 s, then drives off. Keep ticking until shut_down().
  void begin_shutdown(std::int64_t time_us) noexcept;
  bool shut_down() const noexcept;

  const SafetyState& safety() const noexcept;
  const BusState& bus_state() const noexcept;
  const AuxiliaryState& auxiliary_state() const noexcept;
  /// One line for people about where boot stands, e.g. "knee: waiting for boot-up". Static or internal
  /// storage.
  const char* boot_detail() const noexcept;
  bool operational() const noexcept;  ///< cyclic operation has begun
  /// For the log, a line each: what boot has overwritten in each node, and whose firmware is not known.
  /// Allocates.
  std::vector<std::string> boot_report() const;
  /// The same after shut_down(): which drives have their settings back, and which have not. Allocates.
  std::vector<std::string> restore_report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
