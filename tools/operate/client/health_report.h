#pragma once
/// BUS_STATE and SAFETY_STATE of a running robot, listened to and told. Names and numbers come from
/// robot.yaml.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

/// Listens from here on. Nothing waits for it.
class HealthListener {
 public:
  HealthListener(const RunInfo& info, const RobotConfig& robot);

  /// Takes what comes in until `seconds` have passed or `enough()` holds; then the newest is in bus() and
  /// safety().
  template <class Enough>
  void wait(double seconds, Enough enough) {
    const std::int64_t end_us = node_.utime_us() + static_cast<std::int64_t>(1e6 * seconds);
    do {
      node_.wait_for_input(end_us);
      take();
    } while (node_.utime_us() < end_us && !enough());
  }
  const std::optional<sprung_msgs::bus_state_t>& bus() const noexcept { return bus_; }
  const std::optional<sprung_msgs::safety_state_t>& safety() const noexcept { return safety_; }

 private:
  void take();
  InputQueue<sprung_msgs::bus_state_t> buses_{256};
  InputQueue<sprung_msgs::safety_state_t> safeties_{256};
  std::optional<sprung_msgs::bus_state_t> bus_;
  std::optional<sprung_msgs::safety_state_t> safety_;
  Node node_;
};

/// Drives in their order, then encoder cards: the order of BUS_STATE's nodes.
std::string node_name(const RobotConfig& robot, const sprung_msgs::node_health_t& node, std::size_t index);
std::string recovery_text(const sprung_msgs::node_health_t& node);
/// What a node has had: "2 emergencies (last 0x8130 ...), 3 samples missing"; "" where all is well.
std::string node_trouble(const sprung_msgs::node_health_t& node);

/// Drives' temperatures by name, and the battery; null where nothing was heard of them.
nlohmann::ordered_json auxiliary_json(const RobotConfig& robot,
                                      const std::optional<sprung_msgs::auxiliary_state_t>& state);
/// The same in lines for people; none where there is nothing.
std::vector<std::string> auxiliary_lines(const nlohmann::ordered_json& auxiliary);
nlohmann::ordered_json buses_json(const RobotConfig& robot, const sprung_msgs::bus_state_t& state);
nlohmann::ordered_json nodes_json(const RobotConfig& robot, const sprung_msgs::bus_state_t& state);
/// What to do where the bridge says this, in one sentence; "" where nothing is to be done.
std::string safety_advice(const sprung_msgs::safety_state_t& safety);
/// @param age_s since it was heard: keys age_s, stale. Key next: safety_advice().
nlohmann::ordered_json safety_json(const std::optional<sprung_msgs::safety_state_t>& safety,
                                   double age_s = 0.0);
/// safety_json() for people: state, cause, detail, whether that is old, and what to type next where torque is
/// latched off or something is over and not forgotten.
std::string safety_text(const nlohmann::ordered_json& safety);

}  // namespace sprung
