#include "tools/station/foxglove/robot_messages.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung::station {
namespace {

using Json = nlohmann::json;

constexpr double kForceScale_m_N = 0.0012;  // as in page/robot_view.js
constexpr Rgba kEstimated{0.835, 0.369, 0.0, 1.0};
constexpr Rgba kTrue{0.0, 0.62, 0.451, 1.0};
constexpr const char* kWorld = "world";

struct TopicWords {
  const char* name;
  const char* type;
};
constexpr TopicWords words_of(RobotTopic topic) noexcept {
  switch (topic) {
    case RobotTopic::kTransforms:
      return {"/tf", "foxglove.FrameTransforms"};
    case RobotTopic::kShapes:
      return {"/robot", "foxglove.SceneUpdate"};
    case RobotTopic::kForces:
      return {"/forces", "foxglove.SceneUpdate"};
    case RobotTopic::kJointStates:
      return {"/joint_states", "foxglove.JointStates"};
    case RobotTopic::kWrenches:
      return {"/wrenches", "sprung.Wrenches"};
    case RobotTopic::kImu:
      break;
  }
  return {"/imu", "sprung.Imu"};
}

double value(const Frame& frame, int index) {
  return index < 0 ? NAN : static_cast<double>(frame.values[static_cast<std::size_t>(index)]);
}

/// Three fields one behind the other.
Eigen::Vector3d vector(const Frame& frame, int first) {
  if (first < 0) return Eigen::Vector3d::Constant(NAN);
  return {value(frame, first), value(frame, first + 1), value(frame, first + 2)};
}

Eigen::Vector3d vector_of(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

Eigen::Isometry3d pose_of(const Json& thing) {
  const Json& q = thing["quaternion_wxyz"];
  const Eigen::Quaterniond turn(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
                                q[3].get<double>());
  return Eigen::Translation3d(vector_of(thing["position_m"])) * turn;
}

Rgba colour_of(const Json& shape) {
  const Json& c = shape["rgba"];
  return {c[0].get<double>(), c[1].get<double>(), c[2].get<double>(), c[3].get<double>()};
}

void add_capsule(const Json& shape, FoxgloveEntity& entity) {
  const double radius_m = shape["size_m"][0], half_m = shape["size_m"][1];
  const Eigen::Isometry3d pose = pose_of(shape);
  const Rgba colour = colour_of(shape);
  entity.add_cylinder(pose, {2 * radius_m, 2 * radius_m, 2 * half_m}, colour);
  for (const double end_m : {-half_m, half_m}) {
    entity.add_sphere(pose * Eigen::Translation3d(0, 0, end_m), Eigen::Vector3d::Constant(2 * radius_m),
                      colour);
  }
}

void add_shape(const Json& shape, const Json& meshes, FoxgloveEntity& entity) {
  const std::string kind = shape["kind"];
  const Eigen::Vector3d half_m = vector_of(shape["size_m"]);
  const Eigen::Isometry3d pose = pose_of(shape);
  const Rgba colour = colour_of(shape);
  if (kind == "capsule") return add_capsule(shape, entity);
  if (kind == "box") return entity.add_cube(pose, 2 * half_m, colour);
  if (kind == "sphere") return entity.add_sphere(pose, Eigen::Vector3d::Constant(2 * half_m.x()), colour);
  if (kind == "ellipsoid") return entity.add_sphere(pose, 2 * half_m, colour);
  if (kind == "cylinder")
    return entity.add_cylinder(pose, {2 * half_m.x(), 2 * half_m.x(), 2 * half_m.y()}, colour);
  const Json& mesh = meshes[shape["mesh"].get<std::size_t>()];
  entity.add_triangles(pose, mesh["vertices_m"].get<std::vector<float>>(),
                       mesh["triangles"].get<std::vector<int>>(), colour);
}

}  // namespace

const char* name_of(RobotTopic topic) noexcept { return words_of(topic).name; }
const char* type_of(RobotTopic topic) noexcept { return words_of(topic).type; }

Eigen::Isometry3d RobotMessages::Link::at(double angle_rad) const {
  const Eigen::Translation3d anchor(anchor_m);
  return rest * anchor * Eigen::AngleAxisd(angle_rad - zero_rad, axis) * anchor.inverse();
}

RobotMessages::RobotMessages(const RobotConfig& robot, const Json& scene,
                             const std::vector<FrameField>& fields)
    : base_(scene["base"].get<std::size_t>()),
      base_fixed_(scene["base_fixed"].get<bool>()),
      trunk_field_(find_field(fields, "trunk.x_m")),
      turning_field_(find_field(fields, "imu.measured_angular_velocity_rad_s.x")),
      specific_force_field_(find_field(fields, "imu.measured_specific_force_m_s2.x")),
      scene_(std::make_shared<const Json>(scene)) {
  for (const Json& body : (*scene_)["bodies"]) links_.push_back(link_of(body, links_.size(), fields));
  for (const Json& leg : (*scene_)["legs"]) {
    if (!leg.contains("foot_body")) continue;
    const std::string name = leg["name"], prefix = "legs." + name + ".";
    feet_.push_back({name, leg["foot_body"], vector_of(leg["foot_in_body_m"]),
                     find_field(fields, prefix + "foot_force_N.x"),
                     find_field(fields, prefix + "true_contact_force_N.x"),
                     find_field(fields, prefix + "contact")});
  }
  for (const JointConfig& joint : robot.joints) {
    const std::string prefix = "joints." + joint.name + ".";
    joints_.push_back({joint.name, find_field(fields, prefix + "estimated_position_rad"),
                       find_field(fields, prefix + "estimated_velocity_rad_s"),
                       find_field(fields, prefix + "gear_output_torque_Nm")});
  }
}

RobotMessages::Link RobotMessages::link_of(const Json& body, std::size_t index,
                                           const std::vector<FrameField>& fields) const {
  Link link{body["name"], body["parent"], pose_of(body)};
  if (link.name.empty()) link.name = "body_" + std::to_string(index);
  if (!body.contains("joint")) return link;
  const Json& joint = body["joint"];
  link.position_field = find_field(fields,
                                   "joints." + joint["name"].get<std::string>() + ".estimated_position_rad");
  link.axis = vector_of(joint["axis"]);
  link.anchor_m = vector_of(joint["position_m"]);
  link.zero_rad = joint["zero"];
  return link;
}

std::string RobotMessages::message(RobotTopic topic, const Frame& frame, std::uint64_t time_ns) const {
  switch (topic) {
    case RobotTopic::kTransforms:
      return frame_transforms(transforms(frame), time_ns);
    case RobotTopic::kShapes:
      return shapes(time_ns);
    case RobotTopic::kForces:
      return forces(frame, time_ns);
    case RobotTopic::kJointStates:
      return joints(frame, time_ns);
    case RobotTopic::kWrenches:
      return wrenches(frame, time_ns);
    case RobotTopic::kImu:
      break;
  }
  return imu(frame, time_ns);
}

std::string RobotMessages::shapes(std::uint64_t time_ns) const {
  std::vector<FoxgloveEntity> entities;
  const auto add = [&](const std::string& frame, const Json& shapes) {
    entities.emplace_back(frame, frame, true, time_ns);
    for (const Json& shape : shapes) add_shape(shape, (*scene_)["meshes"], entities.back());
  };
  add(kWorld, (*scene_)["world_shapes"]);
  for (std::size_t i = 0; i < links_.size(); ++i) add(links_[i].name, (*scene_)["bodies"][i]["shapes"]);
  return scene_update(entities);
}

Eigen::Isometry3d RobotMessages::trunk(const Frame& frame) const {
  if (base_fixed_) return links_[base_].rest;
  const auto at = [&](int offset) { return value(frame, trunk_field_ + offset); };
  for (int i = 0; i < 7; ++i)
    if (!std::isfinite(at(i))) return links_[base_].rest;
  return Eigen::Translation3d(at(0), at(1), at(2)) * Eigen::Quaterniond(at(3), at(4), at(5), at(6));
}

Eigen::Isometry3d RobotMessages::in_parent(const Frame& frame, std::size_t body) const {
  if (body == base_) return trunk(frame);
  const Link& link = links_[body];
  const double angle_rad = value(frame, link.position_field);
  return std::isfinite(angle_rad) ? link.at(angle_rad) : link.rest;
}

Eigen::Isometry3d RobotMessages::in_world(const Frame& frame, int body) const {
  if (body < 0) return Eigen::Isometry3d::Identity();
  const auto index = static_cast<std::size_t>(body);
  return in_world(frame, links_[index].parent) * in_parent(frame, index);
}

std::vector<FoxgloveTransform> RobotMessages::transforms(const Frame& frame) const {
  std::vector<FoxgloveTransform> out;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const int parent = links_[i].parent;
    out.push_back({parent < 0 ? kWorld : links_[static_cast<std::size_t>(parent)].name, links_[i].name,
                   in_parent(frame, i)});
  }
  return out;
}

Eigen::Vector3d RobotMessages::ground_force_N(const Frame& frame, const Foot& foot) const {
  const bool contact = value(frame, foot.contact_field) > 0.5;
  if (!contact) return Eigen::Vector3d::Constant(NAN);
  return trunk(frame).linear() * vector(frame, foot.force_field);
}

/// An entity a leg, empty where there is no force: it takes the place of the one before.
std::string RobotMessages::forces(const Frame& frame, std::uint64_t time_ns) const {
  constexpr double kTrueDiameter_m = 0.012, kDiameter_m = 0.018;
  std::vector<FoxgloveEntity> entities;
  for (const Foot& foot : feet_) {
    const Eigen::Vector3d foot_m = in_world(frame, foot.body) * foot.in_body_m;
    entities.emplace_back(kWorld, "force " + foot.leg, false, time_ns);
    const Eigen::Vector3d true_N = vector(frame, foot.true_force_field);
    if (true_N.allFinite())
      entities.back().add_arrow(foot_m, kForceScale_m_N * true_N, kTrueDiameter_m, kTrue);
    const Eigen::Vector3d force_N = ground_force_N(frame, foot);
    if (force_N.allFinite())
      entities.back().add_arrow(foot_m, kForceScale_m_N * force_N, kDiameter_m, kEstimated);
  }
  return scene_update(entities);
}

std::string RobotMessages::joints(const Frame& frame, std::uint64_t time_ns) const {
  std::vector<FoxgloveJoint> out;
  for (const Joint& joint : joints_)
    out.push_back(
        {joint.name, value(frame, joint.position), value(frame, joint.velocity), value(frame, joint.torque)});
  return joint_states(out, time_ns);
}

/// A foot that touches nothing has a force of zero.
std::string RobotMessages::wrenches(const Frame& frame, std::uint64_t time_ns) const {
  std::vector<FootWrench> out;
  for (const Foot& foot : feet_) {
    if (!std::isfinite(value(frame, foot.contact_field))) continue;
    const Eigen::Vector3d force_N = ground_force_N(frame, foot);
    out.push_back({foot.leg, kWorld, in_world(frame, foot.body) * foot.in_body_m,
                   force_N.allFinite() ? force_N : Eigen::Vector3d::Zero()});
  }
  return out.empty() ? "" : foot_wrenches(out, time_ns);
}

std::string RobotMessages::imu(const Frame& frame, std::uint64_t time_ns) const {
  const Eigen::Vector3d turning = vector(frame, turning_field_), force = vector(frame, specific_force_field_);
  if (!turning.allFinite() || !force.allFinite()) return "";
  return imu_sample(links_[base_].name, turning, force, time_ns);
}

}  // namespace sprung::station
