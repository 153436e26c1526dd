#include "tools/operate/client/motion_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "planner/gait/body_frame.h"
#include "signals/angles.h"
#include "signals/modes.h"
#include "signals/vec3.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees_per_rad = 180.0 / kPi;

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json events_json(const sprung_msgs::motion_leg_t& leg) {
  Json out = Json::object();
  for (std::size_t i = 1; i < kLegEventCount; ++i) out[name(static_cast<LegEvent>(i))] = leg.event_counts[i];
  return out;
}

Json leg_json(const RobotConfig& robot, const sprung_msgs::motion_leg_t& leg, std::size_t index) {
  Json out{{"name", index < robot.legs.size() ? robot.legs[index].name : std::to_string(index)},
           {"phase", name(static_cast<LegPhase>(leg.phase))},
           {"phase_time_s", leg.phase_time_s}};
  if (robot.gaits.empty()) return out;
  out["last_event"] = name(static_cast<LegEvent>(leg.last_event));
  out["events"] = events_json(leg);
  return out;
}

Json ground_json(const sprung_msgs::motion_state_t& motion) {
  if (!std::isfinite(motion.estimated_ground_slope_bound[0])) return nullptr;
  return {{"slope", motion.estimated_ground_slope}, {"slope_bound", motion.estimated_ground_slope_bound}};
}

Json payload_json(const sprung_msgs::motion_state_t& motion) {
  if (!std::isfinite(motion.estimated_payload_kg)) return nullptr;
  Json out{{"mass_kg", motion.estimated_payload_kg}, {"bound_kg", motion.estimated_payload_bound_kg}};
  out["in_trunk_m"] = Json::array();
  for (const double at_m : motion.estimated_payload_in_trunk_m)
    out["in_trunk_m"].push_back(finite_or_null(at_m));
  return out;
}

Json place_json(const std::optional<sprung_msgs::body_state_t>& odometry) {
  if (!odometry || !std::isfinite(odometry->estimated_position_in_world_m[0])) return nullptr;
  const auto& variance_m2 = odometry->position_covariance_m2;
  return {{"position_m", odometry->estimated_position_in_world_m},
          {"bound_m", 2.0 * std::sqrt(std::max(variance_m2[0], variance_m2[4]))},
          {"slips", odometry->slips}};
}

Json gait_name(const RobotConfig& robot, const sprung_msgs::motion_state_t& motion) {
  const auto gait = static_cast<std::size_t>(motion.gait);
  const bool walks = static_cast<MotionPhase>(motion.state) == MotionPhase::kWalking;
  const bool known = walks && motion.gait >= 0 && gait < robot.gaits.size();
  return known ? Json(robot.gaits[gait].name) : Json(nullptr);
}

/// "3 early contact, 1 slip"; "" where nothing happened.
std::string events_text(const Json& leg) {
  std::string out;
  for (const auto& [event, count] : leg["events"].items()) {
    if (count != 0) out += (out.empty() ? "" : ", ") + count.dump() + " " + event;
  }
  return out;
}

std::string degrees(const Json& angle_rad) {
  char text[24];
  if (angle_rad.is_null()) return "unknown";
  std::snprintf(text, sizeof text, "%.1f deg", kDegrees_per_rad * angle_rad.get<double>());
  return text;
}

std::string gait_line(const Json& motion) {
  char text[160];
  const auto& speed = motion["desired_speed"];
  std::snprintf(text, sizeof text,
                "gait    %s, phase %.2f; wanted %.3f m/s forward, %.3f m/s to the left, turning %.3f rad/s",
                motion["gait"].get<std::string>().c_str(), motion["gait_phase"].get<double>(),
                speed[0].get<double>(), speed[1].get<double>(), speed[2].get<double>());
  return text;
}

std::string body_line(const Json& body) {
  char height[32] = "unknown";
  if (!body["height_m"].is_null())
    std::snprintf(height, sizeof height, "%.3f m", body["height_m"].get<double>());
  return "body    roll " + degrees(body["roll_rad"]) + ", pitch " + degrees(body["pitch_rad"]) + ", yaw " +
         degrees(body["yaw_rad"]) + ", height " + height +
         (body["uses_imu"].get<bool>() ? "; attitude from the IMU"
                                       : "; no IMU: attitude from the standing feet") +
         stale_text(body, "the torque estimator");
}

std::string side(double left_m) { return left_m < 0.0 ? "right" : "left"; }

std::string place_line(const Json& place) {
  char text[160];
  std::snprintf(text, sizeof text,
                "place   %.2f m forward, %.2f m to the %s of where it began, within %.2f m; %d feet slipped",
                place["position_m"][0].get<double>(), std::abs(place["position_m"][1].get<double>()),
                side(place["position_m"][1].get<double>()).c_str(), place["bound_m"].get<double>(),
                place["slips"].get<int>());
  return text;
}

std::string ground_line(const Json& ground) {
  char text[160];
  const auto angle = [&](const char* key, int axis) {
    return kDegrees_per_rad * std::atan(ground[key][axis].get<double>());
  };
  std::snprintf(text, sizeof text,
                "ground  rises %.1f deg forward, within %.1f; %.1f deg to the left, within %.1f",
                angle("slope", 0), angle("slope_bound", 0), angle("slope", 1), angle("slope_bound", 1));
  return text;
}

std::string payload_line(const Json& payload) {
  char text[160];
  const double mass_kg = payload["mass_kg"].get<double>(), bound_kg = payload["bound_kg"].get<double>();
  if (std::abs(mass_kg) <= bound_kg) {
    std::snprintf(text, sizeof text, "load    none that is felt, within %.1f kg", bound_kg);
  } else if (mass_kg < 0.0) {
    std::snprintf(text, sizeof text, "load    %.1f kg, within %.1f: lighter than robot.yaml says", mass_kg,
                  bound_kg);
  } else {
    const double forward_m = payload["in_trunk_m"][0].get<double>(),
                 left_m = payload["in_trunk_m"][1].get<double>();
    std::snprintf(text, sizeof text,
                  "load    %.1f kg, within %.1f, %.2f m %s and %.2f m %s of the middle of the hips", mass_kg,
                  bound_kg, std::abs(forward_m), forward_m < 0.0 ? "behind" : "before", std::abs(left_m),
                  side(left_m).c_str());
  }
  return text;
}

std::string leg_line(const Json& leg) {
  char text[64];
  std::snprintf(text, sizeof text, "leg     %-10s %s for %.2f s", leg["name"].get<std::string>().c_str(),
                leg["phase"].get<std::string>().c_str(), leg["phase_time_s"].get<double>());
  const std::string events = events_text(leg);
  return text + (events.empty() ? "" : "; so far " + events);
}

}  // namespace

std::string stale_text(const Json& told, const char* who) {
  if (!told.value("stale", false)) return "";
  char age[32];
  std::snprintf(age, sizeof age, " for %.1f s", told["age_s"].get<double>());
  return std::string("; STALE: nothing heard of ") + who + age;
}

Json motion_json(const RobotConfig& robot, const std::optional<sprung_msgs::motion_state_t>& motion,
                 double age_s) {
  Json out{{"state", "unknown"}, {"legs", Json::array()}};
  if (!motion) return out;
  out["state"] = motion->state_name;
  out["age_s"] = age_s;
  out["stale"] = age_s > kStale_s;
  out["last_transition"] = motion->last_transition;
  if (!robot.gaits.empty()) {
    out["gait"] = gait_name(robot, *motion);
    out["gait_phase"] = motion->gait_phase;
    out["desired_speed"] = motion->desired_speed;
    out["ground"] = ground_json(*motion);
    out["payload"] = payload_json(*motion);
  }
  for (std::size_t i = 0; i < motion->legs.size(); ++i)
    out["legs"].push_back(leg_json(robot, motion->legs[i], i));
  return out;
}

Json body_json(const RobotConfig& robot, const std::optional<sprung_msgs::joint_state_t>& joints,
               double age_s, const std::optional<sprung_msgs::body_state_t>& odometry) {
  if (!joints || !(robot.body.mass_kg > 0.0)) return nullptr;
  const auto& body = joints->body;
  std::array<double, 4> wxyz{};
  for (std::size_t i = 0; i < 4; ++i) wxyz[i] = body.estimated_quaternion_wxyz[i];
  const bool known = std::isfinite(wxyz[0]);
  const Attitude now = known ? attitude(wxyz) : Attitude{kNaN, kNaN, kNaN};
  Json out{{"uses_imu", body.uses_imu != 0},
           {"roll_rad", finite_or_null(now.roll_rad)},
           {"pitch_rad", finite_or_null(now.pitch_rad)},
           {"yaw_rad", finite_or_null(now.yaw_rad)},
           {"height_m", finite_or_null(body.estimated_height_m)},
           {"age_s", age_s},
           {"stale", age_s > kStale_s},
           {"velocity_m_s", Json::array()}};
  for (const double v : body.estimated_velocity_m_s) out["velocity_m_s"].push_back(finite_or_null(v));
  out["place"] = place_json(odometry);
  return out;
}

std::vector<std::string> motion_lines(const Json& motion, const Json& body) {
  std::vector<std::string> out;
  const std::string why = motion.value("last_transition", "");
  const bool heard = motion.contains("stale");
  out.push_back("motion  " + motion["state"].get<std::string>() + (why.empty() ? "" : ": " + why) +
                (heard ? stale_text(motion, "the motion planner") : ": nothing heard of the motion planner"));
  const bool walks = motion.contains("gait") && !motion["gait"].is_null();
  if (walks) out.push_back(gait_line(motion));
  if (!body.is_null()) out.push_back(body_line(body));
  if (!body.is_null() && !body["place"].is_null()) out.push_back(place_line(body["place"]));
  if (walks && !motion["ground"].is_null()) out.push_back(ground_line(motion["ground"]));
  if (motion.contains("payload") && !motion["payload"].is_null())
    out.push_back(payload_line(motion["payload"]));
  for (const Json& leg : motion["legs"]) {
    const bool befell = leg.contains("events") && !events_text(leg).empty();
    if (walks || befell) out.push_back(leg_line(leg));
  }
  return out;
}

}  // namespace sprung
