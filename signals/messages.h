#pragma once
/// Signals to LCM messages and back, bit for bit (NaN too). Pure: no transport, clock or log. In place: once
/// a message or a signal has its size, converting into it allocates nothing (texts aside).
///
/// to_message fills every field. from_message is not good, and leaves `out` unspecified, when a count
/// differs from the vectors it comes with, an enumeration holds a value that this build does not know, or
/// utime or seq is so far away that its difference from another one would not fit.
#include <cstdint>

#include "signals/reading.h"
#include "sprung_msgs/auxiliary_state_t.hpp"
#include "sprung_msgs/body_state_t.hpp"
#include "sprung_msgs/bus_state_t.hpp"
#include "sprung_msgs/drive_command_t.hpp"
#include "sprung_msgs/drive_state_t.hpp"
#include "sprung_msgs/imu_t.hpp"
#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/leg_command_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "sprung_msgs/operator_command_t.hpp"
#include "sprung_msgs/operator_reply_t.hpp"
#include "sprung_msgs/safety_state_t.hpp"
#include "sprung_msgs/sim_control_t.hpp"
#include "sprung_msgs/sim_truth_t.hpp"
#include "sprung_msgs/torque_sensor_t.hpp"

namespace sprung {

struct BusState;
struct DriveCommand;
struct DriveState;
struct Imu;
struct JointState;
struct LegCommand;
struct MotionState;
struct OperatorCommand;
struct OperatorReply;
struct AuxiliaryState;
struct BodyState;
struct SafetyState;
struct SimControl;
struct SimTruth;
struct TorqueSensor;

void to_message(const DriveState& in, std::int64_t session, sprung_msgs::drive_state_t& out);
void to_message(const DriveCommand& in, std::int64_t session, sprung_msgs::drive_command_t& out);
void to_message(const JointState& in, std::int64_t session, sprung_msgs::joint_state_t& out);
void to_message(const LegCommand& in, std::int64_t session, sprung_msgs::leg_command_t& out);
void to_message(const MotionState& in, std::int64_t session, sprung_msgs::motion_state_t& out);
void to_message(const SafetyState& in, std::int64_t session, sprung_msgs::safety_state_t& out);
void to_message(const OperatorCommand& in, std::int64_t session, sprung_msgs::operator_command_t& out);
void to_message(const OperatorReply& in, std::int64_t session, sprung_msgs::operator_reply_t& out);
void to_message(const BusState& in, std::int64_t session, sprung_msgs::bus_state_t& out);
void to_message(const BodyState& in, std::int64_t session, sprung_msgs::body_state_t& out);
void to_message(const AuxiliaryState& in, std::int64_t session, sprung_msgs::auxiliary_state_t& out);
void to_message(const SimControl& in, std::int64_t session, sprung_msgs::sim_control_t& out);
void to_message(const SimTruth& in, std::int64_t session, sprung_msgs::sim_truth_t& out);
void to_message(const Imu& in, std::int64_t session, sprung_msgs::imu_t& out);
void to_message(const TorqueSensor& in, std::int64_t session, sprung_msgs::torque_sensor_t& out);

[[nodiscard]] Reading from_message(const sprung_msgs::drive_state_t& in, DriveState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::drive_command_t& in, DriveCommand& out);
[[nodiscard]] Reading from_message(const sprung_msgs::joint_state_t& in, JointState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::leg_command_t& in, LegCommand& out);
/// `last_transition` points into `in` and lives as long as it.
[[nodiscard]] Reading from_message(const sprung_msgs::motion_state_t& in, MotionState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::safety_state_t& in, SafetyState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::operator_command_t& in, OperatorCommand& out);
/// `answered_by` and `reason` point into `in` and live as long as it.
[[nodiscard]] Reading from_message(const sprung_msgs::operator_reply_t& in, OperatorReply& out);
[[nodiscard]] Reading from_message(const sprung_msgs::bus_state_t& in, BusState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::body_state_t& in, BodyState& out);
[[nodiscard]] Reading from_message(const sprung_msgs::auxiliary_state_t& in, AuxiliaryState& out);
/// Also not good for numbers that no experiment has.
[[nodiscard]] Reading from_message(const sprung_msgs::sim_control_t& in, SimControl& out);
[[nodiscard]] Reading from_message(const sprung_msgs::sim_truth_t& in, SimTruth& out);
[[nodiscard]] Reading from_message(const sprung_msgs::imu_t& in, Imu& out);
[[nodiscard]] Reading from_message(const sprung_msgs::torque_sensor_t& in, TorqueSensor& out);

/// The message type of a signal: MessageOf<DriveState> is sprung_msgs::drive_state_t.
template <class Signal>
struct MessageOfSignal;
template <class Signal>
using MessageOf = typename MessageOfSignal<Signal>::Type;

template <>
struct MessageOfSignal<BodyState> {
  using Type = sprung_msgs::body_state_t;
};
template <>
struct MessageOfSignal<AuxiliaryState> {
  using Type = sprung_msgs::auxiliary_state_t;
};
template <>
struct MessageOfSignal<Imu> {
  using Type = sprung_msgs::imu_t;
};
template <>
struct MessageOfSignal<TorqueSensor> {
  using Type = sprung_msgs::torque_sensor_t;
};
template <>
struct MessageOfSignal<DriveState> {
  using Type = sprung_msgs::drive_state_t;
};
template <>
struct MessageOfSignal<DriveCommand> {
  using Type = sprung_msgs::drive_command_t;
};
template <>
struct MessageOfSignal<JointState> {
  using Type = sprung_msgs::joint_state_t;
};
template <>
struct MessageOfSignal<LegCommand> {
  using Type = sprung_msgs::leg_command_t;
};
template <>
struct MessageOfSignal<MotionState> {
  using Type = sprung_msgs::motion_state_t;
};
template <>
struct MessageOfSignal<SafetyState> {
  using Type = sprung_msgs::safety_state_t;
};
template <>
struct MessageOfSignal<BusState> {
  using Type = sprung_msgs::bus_state_t;
};
template <>
struct MessageOfSignal<OperatorCommand> {
  using Type = sprung_msgs::operator_command_t;
};
template <>
struct MessageOfSignal<OperatorReply> {
  using Type = sprung_msgs::operator_reply_t;
};
template <>
struct MessageOfSignal<SimControl> {
  using Type = sprung_msgs::sim_control_t;
};
template <>
struct MessageOfSignal<SimTruth> {
  using Type = sprung_msgs::sim_truth_t;
};

}  // namespace sprung
