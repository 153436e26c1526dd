#include "tools/station/foxglove/foxglove_messages.h"

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sprung_embedded/foxglove_schemas.h"
#include "tools/logs/log/mcap_writer.h"
#include "tools/logs/log/proto_bytes.h"

namespace sprung::station {

namespace {

using log::append_delimited;
using log::append_number;

// Numbers of members are those of Foxglove's definitions, 0.4.0, and of make-schemas; the test of
// conformance reads them back by schemas.json.

void append_double(std::size_t field, double value, std::string& out) {
  std::uint64_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  log::append_tag(field, log::ProtoWire::kFixed64, out);
  log::append_little_endian(word, out);
}

void append_fixed32(std::uint32_t value, std::string& out) { log::append_little_endian(value, out); }

std::string numbers(std::initializer_list<double> values) {
  std::string out;
  std::size_t field = 0;
  for (const double value : values) append_double(++field, value, out);
  return out;
}

std::string vector3(const Eigen::Vector3d& v) { return numbers({v.x(), v.y(), v.z()}); }
std::string quaternion(const Eigen::Quaterniond& q) { return numbers({q.x(), q.y(), q.z(), q.w()}); }
std::string colour_of(const Rgba& c) { return numbers({c[0], c[1], c[2], c[3]}); }

std::string timestamp(std::uint64_t time_ns) {
  constexpr std::uint64_t kSecond_ns = 1'000'000'000;
  std::string out;
  append_number(1, time_ns / kSecond_ns, out);
  append_number(2, time_ns % kSecond_ns, out);
  return out;
}

std::string pose_of(const Eigen::Isometry3d& pose) {
  std::string out;
  append_delimited(1, vector3(pose.translation()), out);
  append_delimited(2, quaternion(Eigen::Quaterniond(pose.linear())), out);
  return out;
}

int value_of_base64(char letter) {
  if (letter >= 'A' && letter <= 'Z') return letter - 'A';
  if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
  if (letter >= '0' && letter <= '9') return letter - '0' + 52;
  return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

std::string from_base64(const std::string& text) {
  std::string out;
  unsigned bits = 0;
  int held = 0;
  for (const char letter : text) {
    const int value = value_of_base64(letter);
    if (value < 0) break;  // padding
    bits = bits << 6U | static_cast<unsigned>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out += static_cast<char>(bits >> static_cast<unsigned>(held) & 0xFFU);
  }
  return out;
}

}  // namespace

FoxgloveEntity::FoxgloveEntity(const std::string& frame, const std::string& id, bool locked,
                               std::uint64_t time_ns) {
  append_delimited(1, timestamp(time_ns), bytes_);
  append_delimited(2, frame, bytes_);
  append_delimited(3, id, bytes_);
  append_number(5, locked ? 1 : 0, bytes_);
}

void FoxgloveEntity::add_cube(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m,
                              const Rgba& colour) {
  std::string cube;
  append_delimited(1, pose_of(pose), cube);
  append_delimited(2, vector3(size_m), cube);
  append_delimited(3, colour_of(colour), cube);
  append_delimited(8, cube, bytes_);
}

void FoxgloveEntity::add_sphere(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m,
                                const Rgba& colour) {
  std::string sphere;
  append_delimited(1, pose_of(pose), sphere);
  append_delimited(2, vector3(size_m), sphere);
  append_delimited(3, colour_of(colour), sphere);
  append_delimited(9, sphere, bytes_);
}

void FoxgloveEntity::add_cylinder(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m,
                                  const Rgba& colour) {
  std::string cylinder;
  append_delimited(1, pose_of(pose), cylinder);
  append_delimited(2, vector3(size_m), cylinder);
  append_double(3, 1.0, cylinder);
  append_double(4, 1.0, cylinder);
  append_delimited(5, colour_of(colour), cylinder);
  append_delimited(10, cylinder, bytes_);
}

void FoxgloveEntity::add_arrow(const Eigen::Vector3d& from_m, const Eigen::Vector3d& way_m, double diameter_m,
                               const Rgba& colour) {
  const double length_m = way_m.norm();
  if (!(length_m > 0.0)) return;
  const Eigen::Isometry3d pose = Eigen::Translation3d(from_m) *
                                 Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), way_m);
  std::string arrow;
  append_delimited(1, pose_of(pose), arrow);
  append_double(2, 0.8 * length_m, arrow);
  append_double(3, diameter_m, arrow);
  append_double(4, 0.2 * length_m, arrow);
  append_double(5, 2.5 * diameter_m, arrow);
  append_delimited(6, colour_of(colour), arrow);
  append_delimited(7, arrow, bytes_);
}

void FoxgloveEntity::add_triangles(const Eigen::Isometry3d& pose, const std::vector<float>& vertices_m,
                                   const std::vector<int>& indices, const Rgba& colour) {
  std::string list;
  append_delimited(1, pose_of(pose), list);
  for (std::size_t i = 0; i + 2 < vertices_m.size(); i += 3)
    append_delimited(2, numbers({vertices_m[i], vertices_m[i + 1], vertices_m[i + 2]}), list);
  append_delimited(3, colour_of(colour), list);
  std::string packed;
  for (const int index : indices) append_fixed32(static_cast<std::uint32_t>(index), packed);
  append_delimited(5, packed, list);
  append_delimited(12, list, bytes_);
}

std::string scene_update(const std::vector<FoxgloveEntity>& entities) {
  std::string out;
  for (const FoxgloveEntity& entity : entities) append_delimited(2, entity.bytes(), out);
  return out;
}

std::string frame_transforms(const std::vector<FoxgloveTransform>& transforms, std::uint64_t time_ns) {
  std::string out;
  for (const FoxgloveTransform& transform : transforms) {
    std::string one;
    append_delimited(1, timestamp(time_ns), one);
    append_delimited(2, transform.parent, one);
    append_delimited(3, transform.child, one);
    append_delimited(4, vector3(transform.pose.translation()), one);
    append_delimited(5, quaternion(Eigen::Quaterniond(transform.pose.linear())), one);
    append_delimited(1, one, out);
  }
  return out;
}

std::string joint_states(const std::vector<FoxgloveJoint>& joints, std::uint64_t time_ns) {
  std::string out;
  append_delimited(1, timestamp(time_ns), out);
  for (const FoxgloveJoint& joint : joints) {
    std::string one;
    append_delimited(1, joint.name, one);
    if (std::isfinite(joint.position_rad)) append_double(2, joint.position_rad, one);
    if (std::isfinite(joint.velocity_rad_s)) append_double(3, joint.velocity_rad_s, one);
    if (std::isfinite(joint.effort_Nm)) append_double(5, joint.effort_Nm, one);
    append_delimited(2, one, out);
  }
  return out;
}

std::string foot_wrenches(const std::vector<FootWrench>& wrenches, std::uint64_t time_ns) {
  std::string out;
  append_delimited(1, timestamp(time_ns), out);
  for (const FootWrench& wrench : wrenches) {
    std::string one;
    append_delimited(1, wrench.leg, one);
    append_delimited(2, wrench.frame, one);
    append_delimited(3, vector3(wrench.position_m), one);
    append_delimited(4, vector3(wrench.force_N), one);
    append_delimited(5, vector3(Eigen::Vector3d::Zero()), one);
    append_delimited(2, one, out);
  }
  return out;
}

std::string imu_sample(const std::string& frame, const Eigen::Vector3d& angular_velocity_rad_s,
                       const Eigen::Vector3d& specific_force_m_s2, std::uint64_t time_ns) {
  std::string out;
  append_delimited(1, timestamp(time_ns), out);
  append_delimited(2, frame, out);
  append_delimited(3, vector3(angular_velocity_rad_s), out);
  append_delimited(4, vector3(specific_force_m_s2), out);
  return out;
}

std::string foxglove_schema(const std::string& name) {
  static const nlohmann::json schemas = nlohmann::json::parse(foxglove_schemas());
  return schemas.contains(name) ? from_base64(schemas[name].get<std::string>()) : "";
}

}  // namespace sprung::station
