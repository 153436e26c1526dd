#pragma once
/// BUS_STATE: how the buses and their nodes are. Units and frames: lcmtypes/README.md.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

/// Counters since the bridge began, unless said otherwise.
struct BusHealth {
  BusCondition condition = BusCondition::kActive;
  double load_share = 0.0;  ///< worst-case bits of all frames seen over the bit rate, last second
  std::int64_t sent = 0;    ///< frames
  std::int64_t received = 0;
  std::int64_t send_failed = 0;  ///< not taken by the kernel, all reasons
  std::int64_t no_buffers = 0;   ///< of these: ENOBUFS
  std::int64_t dropped = 0;      ///< lost before the bridge read them
  std::int64_t malformed = 0;
  std::int64_t unexpected = 0;  ///< from an id that no node of the robot has
  std::int64_t error_frames = 0;
  std::int64_t bus_offs = 0;
  std::int64_t restarts = 0;
};

struct NodeHealth {
  std::int32_t bus = 0;
  std::int32_t node = 0;
  std::int32_t actuator = -1;            ///< -1 = an encoder card
  std::int32_t last_emergency_code = 0;  ///< newest that was not 0, also when it is gone
  std::int32_t error_register = 0;
  std::int64_t emergencies = 0;
  std::int64_t boot_ups = 0;             ///< that nobody asked for
  std::int64_t missing_samples = 0;      ///< SYNCs without an answer
  std::int64_t late_samples = 0;         ///< that came after their cycle
  std::int64_t short_frames = 0;         ///< process data of the wrong length; ignored
  std::int64_t duplicate_samples = 0;    ///< a second answer to one SYNC
  std::int64_t implausible_samples = 0;  ///< that cannot be measured positions; kept out
  std::int64_t heartbeat_losses = 0;
  std::int64_t sdo_failures = 0;  ///< aborted or unanswered
  /// Cycles in which the bridge's gate changed a set-point (drivers/bridge/setpoint_gate.h).
  std::int64_t limited_joint_position = 0;
  std::int64_t limited_speed = 0;
  std::int64_t limited_rate = 0;
  std::int64_t limited_power = 0;
  std::int64_t limited_winding = 0;
  std::int64_t limited_by_drive = 0;   ///< cycles with the drive's own "internal limit active"
  double winding_share = 0.0;          ///< 1: as warm as the rated current makes it (winding_watch.h)
  double reference_offset_rad = kNaN;  ///< offset in force; NaN where not referenced
  std::int8_t nmt_state = -1;          ///< CiA 301 state byte; -1 = not known
  ReferenceSource reference_source = ReferenceSource::kConfigured;
  bool operational = false;
  std::array<char, 128> recovery{};  ///< what the last clear did to this node, zero-terminated
};

struct BusState {
  Stamp stamp;
  std::vector<BusHealth> buses;
  std::vector<NodeHealth> nodes;  ///< actuators' drives in their order, then encoder cards
  bool recovering = false;        ///< a clear is under way
  BusState() = default;
  BusState(std::size_t bus_count, std::size_t node_count) : buses(bus_count), nodes(node_count) {}
};

}  // namespace sprung
