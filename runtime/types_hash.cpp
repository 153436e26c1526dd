#include "runtime/types_hash.h"

#include "runtime/message_layout.h"

namespace sprung {
namespace {

// FNV-1a over LCM's own fingerprints, which cover the types inside each.
template <class... Messages>
std::int64_t hash_of() noexcept {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::int64_t fingerprint : {Messages::getHash()...}) {
    hash = (hash ^ static_cast<std::uint64_t>(fingerprint)) * 0x100000001b3U;
  }
  return static_cast<std::int64_t>(hash);
}

}  // namespace

std::int64_t types_hash() noexcept {
  using namespace sprung_msgs;
  return hash_of<auxiliary_state_t, body_state_t, bus_state_t, can_trace_t, drive_command_t, drive_state_t,
                 imu_t, joint_state_t, leg_command_t, motion_state_t, operator_command_t, operator_reply_t,
                 process_status_t, safety_state_t, sim_control_t, sim_truth_t, torque_sensor_t>();
}

}  // namespace sprung
