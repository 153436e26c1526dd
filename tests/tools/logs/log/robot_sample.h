#pragma once
/// Events as a robot's recorder would write them: a joint state, a motion state and now and then a safety
/// state in each cycle.
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "sprung_msgs/drive_command_t.hpp"
#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/log_end_t.hpp"
#include "sprung_msgs/log_metadata_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "sprung_msgs/process_status_t.hpp"
#include "sprung_msgs/safety_state_t.hpp"
#include "tests/support/paths.h"
#include "tests/tools/logs/log/log_sample.h"

namespace sprung::log {

inline constexpr std::int64_t kSampleBegin_us = 1'700'000'000'000'000;  ///< UTC
inline constexpr std::int64_t kSampleCycle_us = 2000;

template <class M>
std::string encoded(const M& message) {
  std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class M>
M stamped(std::int64_t cycle, std::int64_t session = 77) {
  M message{};
  message.session = session;
  message.utime = 5'000'000 + cycle * kSampleCycle_us;
  message.seq = cycle;
  return message;
}

/// Received 300 us after its cycle began.
inline Kept kept(const char* channel, std::int64_t cycle, std::string data) {
  return {0, kSampleBegin_us + cycle * kSampleCycle_us + 300, channel, std::move(data)};
}

/// Torque of joint j in cycle k: j + k / 100; of joint 1 it is NaN in every tenth cycle.
inline Kept joint_event(std::int64_t cycle, std::int64_t session = 77) {
  auto message = stamped<sprung_msgs::joint_state_t>(cycle, session);
  message.n_joints = 2;
  message.joints.resize(2);
  for (int j = 0; j < 2; ++j) {
    message.joints[j].gear_output_torque_Nm = j + static_cast<double>(cycle) / 100.0;
    message.joints[j].at_rest = cycle % 2 == 0;
  }
  if (cycle % 10 == 9) message.joints[1].gear_output_torque_Nm = std::numeric_limits<double>::quiet_NaN();
  return kept(channels::kJointState, cycle, encoded(message));
}

inline Kept command_event(std::int64_t cycle, std::int64_t used_leg_command) {
  auto message = stamped<sprung_msgs::drive_command_t>(cycle);
  message.used_joint_state_seq = cycle;
  message.used_leg_command_seq = used_leg_command;
  return kept(channels::kDriveCommand, cycle, encoded(message));
}

inline Kept motion_event(std::int64_t cycle, const std::string& state, const std::string& why = "",
                         int stumbles = 0) {
  auto message = stamped<sprung_msgs::motion_state_t>(cycle);
  message.n_legs = 1;
  message.legs.resize(1);
  message.legs[0].event_counts[5] = stumbles;
  message.state_name = state;
  message.last_transition = why;
  return kept(channels::kMotionState, cycle, encoded(message));
}

inline Kept safety_event(std::int64_t cycle, const std::string& level, const std::string& cause,
                         const std::string& detail, std::int64_t missed_cycles = 0) {
  auto message = stamped<sprung_msgs::safety_state_t>(cycle);
  message.missed_cycles = missed_cycles;
  message.level_name = level;
  message.cause_name = cause;
  message.detail = detail;
  return kept(channels::kSafetyState, cycle, encoded(message));
}

inline Kept status_event(std::int64_t cycle, const std::string& process, const std::string& detail) {
  auto message = stamped<sprung_msgs::process_status_t>(cycle);
  message.clock = "lockstep";
  message.process = process;
  message.detail = detail;
  return kept(channels::kProcessStatus, cycle, encoded(message));
}

inline constexpr const char* kSampleYaml = "name: no_such_robot\n";

/// The text of a shipped robot's file, with one word for another wherever it stands.
inline std::string robot_yaml(const std::string& robot, const std::string& from = "",
                              const std::string& to = "") {
  std::ifstream in(test::source_dir() + "/robots/" + robot + "/robot.yaml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t at = 0; !from.empty() && (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

inline Kept metadata_event(const std::string& yaml = kSampleYaml, const std::string& clock = "realtime") {
  auto message = stamped<sprung_msgs::log_metadata_t>(-1);
  message.robot = "no_such_robot";
  message.preset = "best";
  message.clock = clock;
  message.command_line = "sprung up no_such_robot";
  message.robot_yaml = yaml;
  return {0, kSampleBegin_us - 1'000'000, channels::kLogMetadata, encoded(message)};
}

inline Kept end_event(std::int64_t cycle, std::int64_t events, std::int64_t missing = 0) {
  auto message = stamped<sprung_msgs::log_end_t>(cycle);
  message.events = events;
  message.missing = missing;
  return kept(channels::kLogEnd, cycle, encoded(message));
}

/// Metadata; `cycles` cycles with a joint and a motion state, standing and then, from the middle, walking;
/// every hundredth cycle and at first a safety state; an end that counts right.
inline std::vector<Kept> robot_events(std::int64_t cycles) {
  std::vector<Kept> events{metadata_event()};
  for (std::int64_t k = 0; k < cycles; ++k) {
    events.push_back(joint_event(k));
    const bool walks = k >= cycles / 2;
    events.push_back(
        motion_event(k, walks ? "walking" : "standing", walks ? "walk requested" : "", walks ? 1 : 0));
    if (k % 100 == 0) events.push_back(safety_event(k, "operational", "none", ""));
  }
  events.push_back(end_event(cycles, static_cast<std::int64_t>(events.size())));
  for (std::size_t i = 0; i < events.size(); ++i) events[i].number = static_cast<std::int64_t>(i);
  return events;
}

}  // namespace sprung::log
