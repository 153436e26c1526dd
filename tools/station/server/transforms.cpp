#include "tools/station/server/transforms.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung::station {
namespace {

using Json = nlohmann::json;

Eigen::Vector3d vector_of(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

Json transform(const std::string& parent, const std::string& child, const Eigen::Vector3d& position_m,
               const Eigen::Quaterniond& attitude, const Json& time) {
  return {{"timestamp", time},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", {{"x", position_m.x()}, {"y", position_m.y()}, {"z", position_m.z()}}},
          {"rotation", {{"x", attitude.x()}, {"y", attitude.y()}, {"z", attitude.z()}, {"w", attitude.w()}}}};
}

}  // namespace

Transforms::Transforms(const Json& scene, const std::vector<FrameField>& fields)
    : trunk_field_(find_field(fields, "trunk.x_m")) {
  if (!scene.contains("bodies")) return;
  for (const Json& each : scene["bodies"]) {
    Body body;
    body.name = each["name"].get<std::string>();
    const int parent = each["parent"].get<int>();
    body.parent = parent < 0 ? "world" : scene["bodies"][parent]["name"].get<std::string>();
    body.position_m = vector_of(each["position_m"]);
    const Json& q = each["quaternion_wxyz"];
    body.attitude = {q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()};
    if (each.contains("joint") && !each["joint"].is_null()) {
      const Json& joint = each["joint"];
      body.angle_field = find_field(fields,
                                    "joints." + joint["name"].get<std::string>() + ".estimated_position_rad");
      body.axis = vector_of(joint["axis"]);
      body.anchor_m = vector_of(joint["position_m"]);
      body.zero_rad = joint["zero"].get<double>();
    }
    bodies_.push_back(std::move(body));
  }
  if (!scene["base_fixed"].get<bool>()) base_ = scene["base"].get<int>();
}

void Transforms::place(const Body& body, const Frame& frame, Eigen::Vector3d& position_m,
                       Eigen::Quaterniond& attitude) const {
  position_m = body.position_m;
  attitude = body.attitude;
  if (base_ >= 0 && &body == &bodies_[static_cast<std::size_t>(base_)]) {
    const float* const trunk = &frame.values[static_cast<std::size_t>(trunk_field_)];
    bool known = true;
    for (int i = 0; i < 7; ++i) known = known && std::isfinite(trunk[i]);
    if (!known) return;
    position_m = {trunk[0], trunk[1], trunk[2]};
    attitude = {trunk[3], trunk[4], trunk[5], trunk[6]};
    return;
  }
  const double angle_rad = body.angle_field < 0
                               ? kNaN
                               : static_cast<double>(
                                     frame.values[static_cast<std::size_t>(body.angle_field)]);
  if (!std::isfinite(angle_rad)) return;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad - body.zero_rad, body.axis));
  position_m += body.attitude * (body.anchor_m - turn * body.anchor_m);
  attitude = body.attitude * turn;
}

std::string Transforms::json(const Frame& frame, std::int64_t time_ns) const {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const Json time{{"sec", time_ns / kSecond_ns}, {"nsec", time_ns % kSecond_ns}};
  Json transforms = Json::array();
  for (const Body& body : bodies_) {
    Eigen::Vector3d position_m;
    Eigen::Quaterniond attitude;
    place(body, frame, position_m, attitude);
    transforms.push_back(transform(body.parent, body.name, position_m, attitude, time));
  }
  return Json({{"transforms", transforms}}).dump();
}

}  // namespace sprung::station
