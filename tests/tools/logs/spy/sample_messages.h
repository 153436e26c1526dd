#pragma once
/// Encoded messages for tests of what looks at them.
#include <cstdint>
#include <vector>

#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "tests/signals/message_bytes.h"

namespace sprung::test {

inline sprung_msgs::joint_state_t joint_state(std::int64_t seq, double torque_Nm) {
  sprung_msgs::joint_state_t message{};
  message.utime = 2000 * seq;
  message.seq = seq;
  message.n_joints = 2;
  message.n_legs = 1;
  message.joints.resize(2);
  message.legs.resize(1);
  message.joints[1].gear_output_torque_Nm = torque_Nm;
  return message;
}

inline std::vector<std::uint8_t> joint_state_bytes(std::int64_t seq, double torque_Nm) {
  return encoded(joint_state(seq, torque_Nm));
}

inline sprung_msgs::motion_state_t motion_state(std::int64_t seq, int phase) {
  sprung_msgs::motion_state_t message{};
  message.utime = 2000 * seq;
  message.seq = seq;
  message.n_legs = 1;
  message.legs.resize(1);
  message.legs[0].phase = static_cast<std::int8_t>(phase);
  message.state = static_cast<std::int8_t>(phase);
  message.state_name = "thrust";
  return message;
}

}  // namespace sprung::test
