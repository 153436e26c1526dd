#pragma once
/// The bridge's link to one node, drive or encoder card: boot, SDO client and the watches over its answers,
/// heartbeats and emergencies. Says what a frame was; what process data mean is the node's (bus_node.h).
/// Stepped by time.
#include <array>
#include <cstdint>
#include <string>

#include "drivers/bridge/emergency_watch.h"
#include "drivers/bridge/guard_watch.h"
#include "drivers/bridge/heartbeat_watch.h"
#include "drivers/bridge/node_boot.h"
#include "drivers/bridge/safety_machine.h"
#include "drivers/bridge/sample_watch.h"
#include "drivers/bridge/second_device_watch.h"
#include "drivers/profiles/drive_profile.h"
#include "signals/bus_state.h"

namespace sprung {

struct NodeSetup {
  std::string name;
  int bus = 0;
  int node = 0;
  int actuator = -1;  ///< -1 = an encoder card
  WatchdogConfig watchdogs;
  NodeWatch watch = NodeWatch::kHeartbeat;
  ReadingConfig watched = {};  ///< without which it is not to run; index 0: none
};

/// What a frame of a node is, and what it has brought about.
struct NodeEvents {
  bool expected = true;      ///< this node has business to send it
  bool sample = false;       ///< process data, to be read as the answer to SYNC
  bool other = false;        ///< process data, of another kind
  bool operational = false;  ///< it is in operation from now on
  bool maybe_off = false;    ///< its supply may have been cut: it booted unasked
};

class NodeLink {
 public:
  /// @param has_power a drive: faults are reset by its control word. Without, only a reset helps.
  NodeLink(const NodeSetup& setup, const IdentityConfig& identity, const NodeProfile& profile,
           bool has_power);

  /// Watches the heartbeat, and boots until the node is in operation; at most one frame.
  /// @return true when its supply may have been cut: it had to be asked, or reset once more.
  bool step(std::int64_t time_us, FrameBatch& out) noexcept;
  /// The question of node guarding, where the node is guarded and it is time.
  void guard(std::int64_t time_us, std::int64_t cycle_us, FrameBatch& out) noexcept;
  NodeEvents receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  void begin_sampling(std::int64_t sync_us) noexcept;
  /// @param accepted samples().to_be_judged(), and it is a new measurement.
  void end_sampling(bool accepted) noexcept;

  /// What is wrong with a node that should be running. @return false when nothing is; `out` is then
  /// untouched but for its cause.
  bool fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept;
  /// Begins the boot anew: reset communication and the whole script.
  void restart() noexcept;
  /// Only a reset of its communication heals this (facts canopen 2.5).
  bool needs_restart(std::int64_t time_us) const noexcept;
  bool silent() const noexcept { return samples_.silent(); }
  bool lost(std::int64_t time_us) const noexcept;  ///< not operational any more, or no heartbeat
  /// It says that it is not operational, and does not answer. One that says so and answers is two devices.
  bool gone() const noexcept;
  bool duplicate() const noexcept { return second_device_.found(); }

  void start() noexcept { boot_.start(); }
  /// Its bus was lost, so it may have let go or restarted unheard; until restart(). @param loss static text,
  /// e.g. "bus was off".
  void doubt(const char* loss) noexcept { bus_loss_ = loss; }
  const char* bus_loss() const noexcept { return bus_loss_; }  ///< "" = none
  /// Faults have been judged: one that the node has withdrawn may now be forgotten.
  void faults_seen() noexcept { emergencies_.judged(); }
  void forget_emergency() noexcept { emergencies_.forget(); }

  const NodeSetup& setup() const noexcept { return setup_; }
  const std::string& name() const noexcept { return setup_.name; }
  const NodeBoot& boot() const noexcept { return boot_; }
  canopen::SdoClient& sdo() noexcept { return sdo_; }
  SampleWatch& samples() noexcept { return samples_; }
  const SampleWatch& samples() const noexcept { return samples_; }
  const HeartbeatWatch& heartbeats() const noexcept { return heartbeats_; }
  const EmergencyWatch& emergencies() const noexcept { return emergencies_; }

  /// What a clear did to this node. @param note added to it; "" = none.
  __attribute__((format(printf, 3, 4))) void set_recovery_text(const char* note, const char* format,
                                                               ...) noexcept;
  /// Counters and states of what every node has.
  NodeHealth health() const noexcept;

 private:
  bool in_operation() const noexcept { return boot_.operational(); }
  void receive_heartbeat(const CanFrame& frame, std::int64_t time_us, NodeEvents& events) noexcept;
  void receive_emergency(const CanFrame& frame) noexcept;
  void receive_process_data(const CanFrame& frame, std::int64_t time_us, NodeEvents& events) noexcept;
  void receive_sample(const CanFrame& frame, std::int64_t time_us, NodeEvents& events) noexcept;
  const char* silence_text() const noexcept;
  bool confirm_operational(std::int64_t time_us) noexcept;

  NodeSetup setup_;
  bool has_power_;
  canopen::SdoClient sdo_;
  NodeBoot boot_;
  std::array<int, canopen::kPdoCount> transmitted_bytes_{};  ///< of each TPDO; -1 = disabled
  int sample_pdo_ = -1;                                      ///< the first TPDO that answers SYNC
  SampleWatch samples_;
  HeartbeatWatch heartbeats_;
  GuardWatch guard_;
  EmergencyWatch emergencies_;
  SecondDeviceWatch second_device_;
  const char* bus_loss_ = "";
  NodeHealth health_;  ///< what no watch counts
};

}  // namespace sprung
