#include "tools/operate/client/model_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/utc_text.h"
#include "signals/modes.h"
#include "tools/operate/launcher/record_command.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json model_json(const RobotConfig& robot, const JointConfig& joint,
                const sprung_msgs::estimated_joint_t& estimated) {
  const bool fits = estimated.model.model_fits != 0;
  return {{"name", joint.name},
          {"identified", estimated.identified != 0},
          {"fits", fits},
          {"ratio", estimated.model.misfit_ratio},
          {"likely_reason", name(static_cast<MisfitReason>(estimated.model.misfit_reason))},
          {"repeat", fits ? Json(nullptr) : Json(record_command(robot, joint))},
          {"dry_friction_factor", estimated.model.dry_friction_factor},
          {"viscous_friction_factor", estimated.model.viscous_friction_factor},
          {"winding_share", number_or_null(estimated.heat.winding_share)},
          {"derating_in_s", number_or_null(estimated.heat.derating_in_s)}};
}

/// Empty: it is far off, or there already, which its drive's own line tells (health_report.h).
std::string derating_line(const Json& model) {
  constexpr double kSoon_s = 30.0;  // [design choice]
  if (model["derating_in_s"].is_null()) return "";
  const double in_s = model["derating_in_s"].get<double>();
  if (!(in_s > 0.0 && in_s < kSoon_s)) return "";
  char text[160];
  std::snprintf(text, sizeof text,
                "motor   %-10s at %.0f %% of its warmth, its rated current alone in %.0f s",
                model["name"].get<std::string>().c_str(), 100.0 * model["winding_share"].get<double>(), in_s);
  return text;
}

/// Empty: it is not.
std::string why_doubtful(const RobotConfig& robot, const JointConfig& joint, const std::string& today) {
  if (!joint.friction) return "";
  const IdentificationRecord& record = joint.friction->record;
  if (identified_on_another(record, robot.name))
    return "identified on " + record.robot + ", bounds are wide until motion has shown that it fits";
  const long days = days_between(record.date, today);
  if (days <= record.max_age_days) return "";
  return "identified " + std::to_string(days) +
         " days ago, more than max_age_days: " + std::to_string(record.max_age_days);
}

}  // namespace

Json models_json(const RobotConfig& robot, const std::optional<sprung_msgs::joint_state_t>& joints) {
  Json out = Json::array();
  if (!joints) return out;
  const std::size_t count = std::min(robot.joints.size(), joints->joints.size());
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(model_json(robot, robot.joints[i], joints->joints[i]));
  return out;
}

std::vector<std::string> model_lines(const Json& models) {
  std::vector<std::string> out;
  for (const Json& model : models) {
    if (const std::string soon = derating_line(model); !soon.empty()) out.push_back(soon);
    if (model["fits"].get<bool>()) continue;
    const auto reason = model["likely_reason"].get<std::string>();
    const bool known = reason != name(MisfitReason::kNone);
    char text[160];
    std::snprintf(text, sizeof text, "model   %-10s does not fit: %s; %.1f times what robot.yaml states",
                  model["name"].get<std::string>().c_str(),
                  known ? ("likely " + reason).c_str() : "motion has not told why yet",
                  model["ratio"].get<double>());
    out.push_back(text + std::string("; repeat: ") + model["repeat"].get<std::string>());
  }
  return out;
}

/// Joints of one reason in a line: a robot is identified in one go.
std::vector<std::string> doubtful_identifications(const RobotConfig& robot, const std::string& today) {
  std::map<std::string, std::vector<const JointConfig*>> by_reason;
  for (const JointConfig& joint : robot.joints) {
    if (const std::string why = why_doubtful(robot, joint, today); !why.empty())
      by_reason[why].push_back(&joint);
  }
  std::vector<std::string> out;
  for (const auto& [why, joints] : by_reason) {
    std::string names;
    for (const JointConfig* joint : joints) names += (names.empty() ? "" : ", ") + joint->name;
    out.push_back(why + ": " + names + "; repeat: " + record_command(robot, *joints.front()));
  }
  return out;
}

std::vector<std::string> doubtful_zeros(const RobotConfig& robot, const std::string& today) {
  std::map<std::string, std::string> by_reason;
  for (const ActuatorConfig& actuator : robot.actuators) {
    const long days = days_between(actuator.referenced_on, today);
    if (actuator.referenced_on.empty() || days <= actuator.reference.max_age_days) continue;
    std::string& names = by_reason["zeros of robot.yaml found " + std::to_string(days) +
                                   " days ago, more than max_age_days: " +
                                   std::to_string(actuator.reference.max_age_days)];
    names += (names.empty() ? "" : ", ") + actuator.name;
  }
  std::vector<std::string> out;
  out.reserve(by_reason.size());
  for (const auto& [why, names] : by_reason)
    out.push_back(why + ": " + names + "; look at the robot in its jig, then renew offset and referenced_on");
  return out;
}

}  // namespace sprung
