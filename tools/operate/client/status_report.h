#pragma once
/// What is heard of a running robot, as `sprung status --json` and the live page tell it.
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "robots/robot_config.h"
#include "runtime/message_layout.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

/// The newest of its kind, and when it came in.
template <class Message>
struct Newest {
  std::optional<Message> message;
  std::int64_t heard_us = 0;

  void take(Message next, std::int64_t now_us) {
    message = std::move(next);
    heard_us = now_us;
  }
  double age_s(std::int64_t now_us) const { return 1e-6 * static_cast<double>(now_us - heard_us); }
};

struct HeardRobot {
  std::map<std::string, sprung_msgs::process_status_t> processes;  ///< the last word of each
  Newest<sprung_msgs::motion_state_t> motion;
  Newest<sprung_msgs::joint_state_t> joints;
  Newest<sprung_msgs::body_state_t> body;
  Newest<sprung_msgs::safety_state_t> safety;
  Newest<sprung_msgs::bus_state_t> buses;
  Newest<sprung_msgs::auxiliary_state_t> auxiliary;
  std::int64_t now_us = 0;  ///< to which ages count
};

/// As in /proc/PID/stat; X where there is no such process. S, asleep, for those of another computer: only
/// what they say is known.
char run_state(const RunInfo& info, const RunningProcess& process);

/// A row for each process of the run: name, state ("dead" when the launcher's child is gone, "stopped" when
/// somebody halted it, "silent" when it says nothing), pid, rate and what else it tells. Reads /proc.
nlohmann::ordered_json processes_json(const RunInfo& info, const HeardRobot& heard);
/// Keys safety, buses, nodes, auxiliary, motion, models, body.
nlohmann::ordered_json health_json(const RobotConfig& robot, const HeardRobot& heard);
/// Keys robot, preset, clock, simulation, maintenance, instance, lcm_url, log, processes, and those of
/// health_json().
nlohmann::ordered_json status_json(const RunInfo& info, const RobotConfig& robot, const HeardRobot& heard);

}  // namespace sprung
