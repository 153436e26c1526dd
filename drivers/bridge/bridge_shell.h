#pragma once
/// What the bridge's process does in both clocks around the core: publish the cycle, keep the trace, serve
/// operators, take DRIVE_COMMANDs. The clocks themselves are bridge_lockstep.cpp and bridge_realtime.cpp.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/bridge/bridge_core.h"
#include "drivers/bridge/reference_store_shell.h"
#include "drivers/can/can_bus.h"
#include "runtime/process.h"
#include "signals/bus_state.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"

namespace sprung {

struct BridgeProgramOptions {
  std::vector<std::string> can;         ///< BUS=ADDRESS, instead of robot.yaml's
  std::vector<std::string> inject_can;  ///< lock-step: faults of the CAN link, see parse_burst_faults
  std::int64_t cycles = 0;              ///< end after that many, 0 = never
  double speed = 0.0;  ///< lock-step only: at most so many times real time, 0 = as fast as it goes
};

class BridgeShell {
 public:
  BridgeShell(Process& process, BridgeCore& core);

  void publish_cycle(const DriveState& state);
  /// `running` on PROCESS_STATUS once safety lets the robot move: that is what `sprung up` waits for.
  void follow_start();
  /// After an orderly end: whose settings are back, and what was overwritten by a boot that never got to its
  /// end.
  void report_end();
  /// The last DRIVE_STATE again, for whoever lost it or whose answer was lost.
  void repeat_drive_state();
  /// SAFETY_STATE and BUS_STATE while no cycle runs yet: on change and at 10 Hz of wall time.
  void publish_boot();
  /// On change and at 10 Hz; in lock-step a cycle that is missed is a change, so that logs have it exactly.
  void publish_safety_if_due(std::int64_t now_us);
  void trace(const FrameBatch& frames, bool sent, std::int64_t time_us);
  void trace(int bus, const CanFrame& frame, bool sent, std::int64_t time_us);
  void serve_operators(std::int64_t time_us);
  /// What a CAN bus has counted, for BUS_STATE; real time only, since it depends on the wall clock.
  void count_traffic(int bus, const CanBusCounters& counters);
  /// @return true when a DRIVE_COMMAND newer than the last taken has come in.
  bool take_command(DriveCommand& out);
  /// Whether DRIVE_COMMAND(seq) or a newer one was taken.
  bool has_command(std::int64_t seq) const { return last_command_seq_ >= seq; }

 private:
  void publish_buses_if_due(std::int64_t now_us);
  void publish_auxiliary_if_due(std::int64_t now_us);
  void publish_replies();
  void restore_references();
  void store_references();
  void publish_trace(const Stamp& stamp);
  void tell_boot();

  Process& process_;
  BridgeCore& core_;
  DriveState last_state_;
  Slot<DriveCommand> commands_;
  InputQueue<OperatorCommand> operators_;
  Publisher<DriveState> drive_states_;
  Publisher<SafetyState> safety_states_;
  Publisher<BusState> bus_states_;
  Publisher<AuxiliaryState> auxiliary_states_;
  Publisher<OperatorReply> replies_;
  sprung_msgs::can_trace_t trace_;
  SafetyState last_safety_;
  std::int64_t next_safety_us_ = 0;
  BusState last_buses_;
  std::int64_t next_buses_us_ = 0;
  std::int64_t next_auxiliary_us_ = 0;
  bool told_low_battery_ = false;
  bool told_boot_ = false;
  std::optional<ReferenceStore> references_;  ///< none in lock-step: a run must not depend on what was before
  std::int64_t stored_homings_ = 0;
  std::int64_t last_command_seq_ = -1;
  std::int64_t trace_lost_ = 0;
  std::int64_t reported_lost_ = 0;
};

int run_bridge_lockstep(Process& process, const BridgeProgramOptions& options);
int run_bridge_realtime(Process& process, const BridgeProgramOptions& options);

}  // namespace sprung
