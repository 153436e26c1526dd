#pragma once
/// What may vary in a message's encoding, so that bytes can be checked before LCM's decoder sees them. Every
/// message begins with hash, session, utime, seq (8 bytes each, big endian); then come up to two counts
/// (int32); strings, if any, come last.
#include <array>
#include <cstddef>
#include <cstdint>

#include "signals/message_mac.h"
#include "sprung_msgs/auxiliary_state_t.hpp"
#include "sprung_msgs/body_state_t.hpp"
#include "sprung_msgs/bus_state_t.hpp"
#include "sprung_msgs/can_trace_t.hpp"
#include "sprung_msgs/drive_command_t.hpp"
#include "sprung_msgs/drive_state_t.hpp"
#include "sprung_msgs/imu_t.hpp"
#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/leg_command_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "sprung_msgs/operator_command_t.hpp"
#include "sprung_msgs/operator_reply_t.hpp"
#include "sprung_msgs/process_status_t.hpp"
#include "sprung_msgs/safety_state_t.hpp"
#include "sprung_msgs/sim_control_t.hpp"
#include "sprung_msgs/sim_truth_t.hpp"
#include "sprung_msgs/torque_sensor_t.hpp"

namespace sprung {

inline constexpr std::size_t kSessionOffset = 8;
inline constexpr std::size_t kUtimeOffset = 16;
inline constexpr std::size_t kSeqOffset = 24;
inline constexpr std::size_t kCountsOffset = 32;

/// What a message carries as proof that it is true: the last kMacBytes of its encoding (message_key.h), and
/// by which rule of freshness.h it is new.
enum class Proof {
  kNone,
  kCycle,         ///< one sender, one message a cycle
  kEvent,         ///< several senders, now and then; stamped anew whenever it is sent again
  kRepeatedEvent  ///< the same, but sent several times with one stamp
};

struct MessageLayout {
  std::int64_t hash = 0;
  int counts = 0;                             ///< leading counts, 0..2
  int strings = 0;                            ///< at the end
  Proof proof = Proof::kNone;                 ///< kNone exactly where the type has no MAC
  std::size_t fixed_size = 0;                 ///< bytes with all counts zero, without the strings
  std::array<std::size_t, 2> element_size{};  ///< bytes for each element that a count counts
};

/// Which counts a receiver accepts; a count that the type does not have is ignored.
struct CountLimits {
  std::array<std::int32_t, 2> least{};
  std::array<std::int32_t, 2> most{};
  static CountLimits none() { return {}; }
  static CountLimits exactly(std::size_t first, std::size_t second = 0);
  static CountLimits up_to(std::size_t first, std::size_t second = 0);
};

/// Layout of message type M; known for every type included above. Start-up only: it builds prototypes.
template <class M>
MessageLayout layout_of();
template <>
MessageLayout layout_of<sprung_msgs::drive_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::drive_command_t>();
template <>
MessageLayout layout_of<sprung_msgs::joint_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::leg_command_t>();
template <>
MessageLayout layout_of<sprung_msgs::motion_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::bus_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::auxiliary_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::can_trace_t>();
template <>
MessageLayout layout_of<sprung_msgs::sim_truth_t>();
template <>
MessageLayout layout_of<sprung_msgs::sim_control_t>();
template <>
MessageLayout layout_of<sprung_msgs::imu_t>();
template <>
MessageLayout layout_of<sprung_msgs::body_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::torque_sensor_t>();
template <>
MessageLayout layout_of<sprung_msgs::operator_command_t>();
template <>
MessageLayout layout_of<sprung_msgs::operator_reply_t>();
template <>
MessageLayout layout_of<sprung_msgs::safety_state_t>();
template <>
MessageLayout layout_of<sprung_msgs::process_status_t>();

/// Big-endian numbers as LCM encodes them; the caller has checked that the bytes are there.
std::int64_t read_int64(const std::uint8_t* data, std::size_t offset) noexcept;
std::int32_t read_int32(const std::uint8_t* data, std::size_t offset) noexcept;

}  // namespace sprung
