#include "runtime/message_layout.h"

#include <endian.h>

#include <cstddef>
#include <cstring>
#include <limits>

namespace sprung {
namespace {

std::int32_t limited(std::size_t count) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(count < kMost ? count : kMost);
}

/// Encoded size of an empty string: its length and the terminating zero.
constexpr std::size_t kEmptyString = 5;

template <class M>
std::size_t size_of(const M& message) {
  return static_cast<std::size_t>(message.getEncodedSize());
}

/// @param strings number of strings at the end of M.
template <class M>
MessageLayout without_counts(int strings) {
  MessageLayout layout;
  layout.hash = M::getHash();
  layout.strings = strings;
  if (kHasMac<M>) layout.proof = Proof::kCycle;
  layout.fixed_size = size_of(M()) - static_cast<std::size_t>(strings) * kEmptyString;
  return layout;
}

/// @param count member of M that says how many `elements` there are.
template <class M, class Count, class Elements>
void add_count(MessageLayout& layout, Count M::*count, Elements M::*elements, std::size_t strings) {
  M one = M();
  one.*count = 1;
  (one.*elements).resize(1);
  const std::size_t size = size_of(one) - strings * kEmptyString;
  layout.element_size[layout.counts++] = size - layout.fixed_size;
}

template <class M, class Count, class Elements>
MessageLayout with_count(Count M::*count, Elements M::*elements, int strings = 0) {
  MessageLayout layout = without_counts<M>(strings);
  add_count(layout, count, elements, static_cast<std::size_t>(strings));
  return layout;
}

template <class M>
MessageLayout event(Proof proof) {
  static_assert(kHasMac<M>);
  MessageLayout layout = without_counts<M>(0);
  layout.proof = proof;
  return layout;
}

template <class M>
MessageLayout joints_and_legs() {
  MessageLayout layout = with_count(&M::n_joints, &M::joints);
  add_count(layout, &M::n_legs, &M::legs, 0);
  return layout;
}

}  // namespace

CountLimits CountLimits::exactly(std::size_t first, std::size_t second) {
  const std::array<std::int32_t, 2> counts{limited(first), limited(second)};
  return {counts, counts};
}

CountLimits CountLimits::up_to(std::size_t first, std::size_t second) {
  return {{0, 0}, {limited(first), limited(second)}};
}

template <>
MessageLayout layout_of<sprung_msgs::drive_state_t>() {
  return with_count(&sprung_msgs::drive_state_t::n, &sprung_msgs::drive_state_t::actuators);
}
template <>
MessageLayout layout_of<sprung_msgs::drive_command_t>() {
  return with_count(&sprung_msgs::drive_command_t::n, &sprung_msgs::drive_command_t::actuators);
}
template <>
MessageLayout layout_of<sprung_msgs::joint_state_t>() {
  return joints_and_legs<sprung_msgs::joint_state_t>();
}
template <>
MessageLayout layout_of<sprung_msgs::leg_command_t>() {
  return with_count(&sprung_msgs::leg_command_t::n_legs, &sprung_msgs::leg_command_t::legs);
}
template <>
MessageLayout layout_of<sprung_msgs::motion_state_t>() {
  return with_count(&sprung_msgs::motion_state_t::n_legs, &sprung_msgs::motion_state_t::legs, 2);
}
template <>
MessageLayout layout_of<sprung_msgs::bus_state_t>() {
  MessageLayout layout = with_count(&sprung_msgs::bus_state_t::n_buses, &sprung_msgs::bus_state_t::buses);
  add_count(layout, &sprung_msgs::bus_state_t::n_nodes, &sprung_msgs::bus_state_t::nodes, 0);
  return layout;
}
template <>
MessageLayout layout_of<sprung_msgs::auxiliary_state_t>() {
  return with_count(&sprung_msgs::auxiliary_state_t::n_actuators,
                    &sprung_msgs::auxiliary_state_t::measured_temperature_degC);
}
template <>
MessageLayout layout_of<sprung_msgs::can_trace_t>() {
  return with_count(&sprung_msgs::can_trace_t::n, &sprung_msgs::can_trace_t::frames);
}
template <>
MessageLayout layout_of<sprung_msgs::sim_truth_t>() {
  return joints_and_legs<sprung_msgs::sim_truth_t>();
}
template <>
MessageLayout layout_of<sprung_msgs::sim_control_t>() {
  return event<sprung_msgs::sim_control_t>(Proof::kRepeatedEvent);
}
template <>
MessageLayout layout_of<sprung_msgs::body_state_t>() {
  return without_counts<sprung_msgs::body_state_t>(0);
}
template <>
MessageLayout layout_of<sprung_msgs::imu_t>() {
  return without_counts<sprung_msgs::imu_t>(0);
}
template <>
MessageLayout layout_of<sprung_msgs::torque_sensor_t>() {
  return without_counts<sprung_msgs::torque_sensor_t>(0);
}
template <>
MessageLayout layout_of<sprung_msgs::operator_command_t>() {
  return event<sprung_msgs::operator_command_t>(Proof::kEvent);
}
template <>
MessageLayout layout_of<sprung_msgs::operator_reply_t>() {
  return without_counts<sprung_msgs::operator_reply_t>(2);
}
template <>
MessageLayout layout_of<sprung_msgs::safety_state_t>() {
  return without_counts<sprung_msgs::safety_state_t>(3);
}
template <>
MessageLayout layout_of<sprung_msgs::process_status_t>() {
  return without_counts<sprung_msgs::process_status_t>(8);
}

std::int64_t read_int64(const std::uint8_t* data, std::size_t offset) noexcept {
  std::uint64_t value = 0;
  std::memcpy(&value, data + offset, sizeof value);
  return static_cast<std::int64_t>(be64toh(value));
}

std::int32_t read_int32(const std::uint8_t* data, std::size_t offset) noexcept {
  std::uint32_t value = 0;
  std::memcpy(&value, data + offset, sizeof value);
  return static_cast<std::int32_t>(be32toh(value));
}

}  // namespace sprung
