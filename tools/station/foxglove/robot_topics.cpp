#include "tools/station/foxglove/robot_topics.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/station/foxglove/foxglove_messages.h"
#include "tools/station/frames/frames.h"
#include "tools/station/frames/version_notes.h"

namespace sprung::station {

namespace {

using Json = nlohmann::json;

constexpr double kMost_Hz = 100.0;
constexpr double kForceScale_m_N = 0.0012;  // as in page/robot_view.js
constexpr Rgba kEstimated{0.835, 0.369, 0.0, 1.0};
constexpr Rgba kTrue{0.0, 0.62, 0.451, 1.0};
constexpr const char* kWorld = "world";

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

/// One body, and where it is in its parent at each angle of its joint.
struct Link {
  std::string name;
  int parent = -1;
  Eigen::Isometry3d rest;
  int position_field = -1;  ///< of the joint's angle; -1 = it does not turn
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX(), anchor_m = Eigen::Vector3d::Zero();
  double zero_rad = 0.0;

  Eigen::Isometry3d at(double angle_rad) const {
    const Eigen::Translation3d anchor(anchor_m);
    return rest * anchor * Eigen::AngleAxisd(angle_rad - zero_rad, axis) * anchor.inverse();
  }
};

class RobotTopics : public log::McapAdditions {
 public:
  RobotTopics(const RobotConfig& robot, const Json& scene, std::string model_xml)
      : robot_(robot), scene_(scene), model_xml_(std::move(model_xml)), frames_(robot) {
    for (const Json& body : scene_["bodies"]) links_.push_back(link_of(body));
    base_ = scene_["base"].get<std::size_t>();
    trunk_field_ = field("trunk.x_m");
  }

  void begin(log::McapWriter& writer) override {
    tf_ = channel(writer, "/tf", "foxglove.FrameTransforms");
    shapes_ = channel(writer, "/robot", "foxglove.SceneUpdate");
    forces_ = channel(writer, "/forces", "foxglove.SceneUpdate", schema_);
    joints_ = channel(writer, "/joint_states", "foxglove.JointStates");
    if (!model_xml_.empty()) writer.add_attachment(0, "model.xml", "application/xml", model_xml_);
  }
  std::vector<log::McapAddition> add(const log::Event& event, double time_s, std::int64_t begin_us) override {
    begin_us_ = begin_us;
    return messages_of(frames_.add(event.channel, event.data, event.size, time_s));
  }
  std::vector<log::McapAddition> finish() override { return messages_of(frames_.finish()); }
  std::vector<std::string> notes(const std::string& maker) const override {
    std::vector<std::string> notes = version_notes(frames_, maker);
    if (shapes_.sequence == 0) notes.push_back(no_pose(frames_, maker));
    return notes;
  }

 private:
  struct Topic {
    std::uint16_t id = 0;
    std::uint32_t sequence = 0;
  };

  int field(const std::string& name) const { return find_field(frames_.fields(), name); }
  double value(const Frame& frame, int index) const {
    return index < 0 ? NAN : static_cast<double>(frame.values[static_cast<std::size_t>(index)]);
  }

  Link link_of(const Json& body) const {
    Link link{body["name"], body["parent"], pose_of(body)};
    if (link.name.empty()) link.name = "body_" + std::to_string(links_.size());
    if (!body.contains("joint")) return link;
    const Json& joint = body["joint"];
    link.position_field = field("joints." + joint["name"].get<std::string>() + ".estimated_position_rad");
    link.axis = vector_of(joint["axis"]);
    link.anchor_m = vector_of(joint["position_m"]);
    link.zero_rad = joint["zero"];
    return link;
  }

  Topic channel(log::McapWriter& writer, const std::string& topic, const std::string& type,
                std::uint16_t known_schema = 0) {
    schema_ = known_schema != 0 ? known_schema : writer.add_schema(type, "protobuf", foxglove_schema(type));
    return {writer.add_channel(schema_, topic, "protobuf"), 0};
  }
  static log::McapAddition message(Topic& topic, std::uint64_t time_ns, std::string data) {
    return {{topic.id, topic.sequence++, time_ns, time_ns}, std::move(data)};
  }

  std::vector<log::McapAddition> messages_of(const Frame* frame) {
    if (frame == nullptr || frame->time_s < next_s_ || !frames_.has_pose(*frame)) return {};
    next_s_ = frame->time_s + 1.0 / kMost_Hz;
    const auto time_ns = static_cast<std::uint64_t>(
                             std::llround(static_cast<double>(begin_us_) + 1e6 * frame->time_s)) *
                         1000;
    std::vector<log::McapAddition> out;
    if (shapes_.sequence == 0) out.push_back(message(shapes_, time_ns, shapes(time_ns)));
    out.push_back(message(tf_, time_ns, frame_transforms(transforms(*frame), time_ns)));
    out.push_back(message(forces_, time_ns, forces(*frame, time_ns)));
    out.push_back(message(joints_, time_ns, joints(*frame, time_ns)));
    return out;
  }

  std::string shapes(std::uint64_t time_ns) const {
    std::vector<FoxgloveEntity> entities;
    const auto add = [&](const std::string& frame, const Json& shapes) {
      entities.emplace_back(frame, frame, true, time_ns);
      for (const Json& shape : shapes) add_shape(shape, scene_["meshes"], entities.back());
    };
    add(kWorld, scene_["world_shapes"]);
    for (std::size_t i = 0; i < links_.size(); ++i) add(links_[i].name, scene_["bodies"][i]["shapes"]);
    return scene_update(entities);
  }

  Eigen::Isometry3d trunk(const Frame& frame) const {
    if (scene_["base_fixed"].get<bool>()) return links_[base_].rest;
    const auto at = [&](int offset) { return value(frame, trunk_field_ + offset); };
    return Eigen::Translation3d(at(0), at(1), at(2)) * Eigen::Quaterniond(at(3), at(4), at(5), at(6));
  }
  Eigen::Isometry3d in_parent(const Frame& frame, std::size_t body) const {
    if (body == base_) return trunk(frame);
    const Link& link = links_[body];
    const double angle_rad = value(frame, link.position_field);
    return std::isfinite(angle_rad) ? link.at(angle_rad) : link.rest;
  }
  Eigen::Isometry3d in_world(const Frame& frame, int body) const {
    if (body < 0) return Eigen::Isometry3d::Identity();
    const auto index = static_cast<std::size_t>(body);
    return in_world(frame, links_[index].parent) * in_parent(frame, index);
  }
  std::vector<FoxgloveTransform> transforms(const Frame& frame) const {
    std::vector<FoxgloveTransform> out;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const int parent = links_[i].parent;
      out.push_back({parent < 0 ? kWorld : links_[static_cast<std::size_t>(parent)].name, links_[i].name,
                     in_parent(frame, i)});
    }
    return out;
  }

  Eigen::Vector3d vector(const Frame& frame, const std::string& name) const {
    return {value(frame, field(name + ".x")), value(frame, field(name + ".y")),
            value(frame, field(name + ".z"))};
  }
  /// An entity a leg, empty where there is no force: it takes the place of the one before.
  std::string forces(const Frame& frame, std::uint64_t time_ns) const {
    std::vector<FoxgloveEntity> entities;
    for (const Json& leg : scene_["legs"]) {
      if (!leg.contains("foot_body")) continue;
      const std::string name = leg["name"], prefix = "legs." + name + ".";
      const Eigen::Vector3d foot_m = in_world(frame, leg["foot_body"]) * vector_of(leg["foot_in_body_m"]);
      entities.emplace_back(kWorld, "force " + name, false, time_ns);
      constexpr double kTrueDiameter_m = 0.012, kDiameter_m = 0.018;
      const Eigen::Vector3d true_N = vector(frame, prefix + "true_contact_force_N");
      if (true_N.allFinite())
        entities.back().add_arrow(foot_m, kForceScale_m_N * true_N, kTrueDiameter_m, kTrue);
      const Eigen::Vector3d force_N = trunk(frame).linear() * vector(frame, prefix + "foot_force_N");
      const bool contact = value(frame, field(prefix + "contact")) > 0.5;
      if (contact && force_N.allFinite())
        entities.back().add_arrow(foot_m, kForceScale_m_N * force_N, kDiameter_m, kEstimated);
    }
    return scene_update(entities);
  }

  std::string joints(const Frame& frame, std::uint64_t time_ns) const {
    std::vector<FoxgloveJoint> out;
    for (const JointConfig& joint : robot_.joints) {
      const std::string prefix = "joints." + joint.name + ".";
      out.push_back({joint.name, value(frame, field(prefix + "estimated_position_rad")),
                     value(frame, field(prefix + "estimated_velocity_rad_s")),
                     value(frame, field(prefix + "gear_output_torque_Nm"))});
    }
    return joint_states(out, time_ns);
  }

  RobotConfig robot_;
  Json scene_;
  std::string model_xml_;
  Frames frames_;
  std::vector<Link> links_;
  std::size_t base_ = 0;
  int trunk_field_ = -1;
  std::uint16_t schema_ = 0;
  Topic tf_, shapes_, forces_, joints_;
  std::int64_t begin_us_ = 0;
  double next_s_ = 0.0;
};

}  // namespace

std::unique_ptr<log::McapAdditions> make_robot_topics(const RobotConfig& robot, const nlohmann::json& scene,
                                                      const std::string& model_xml) {
  return std::make_unique<RobotTopics>(robot, scene, model_xml);
}

}  // namespace sprung::station
