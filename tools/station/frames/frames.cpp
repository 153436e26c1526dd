#include "tools/station/frames/frames.h"

#include <algorithm>
#include <cmath>

#include "lcmtypes/channels.h"
#include "signals/modes.h"

namespace sprung::station {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// false: it comes when something changes, once a second, or in every fifth cycle.
bool comes_every_cycle(const std::string& channel) {
  return channel != channels::kSafetyState && channel != channels::kAuxiliaryState &&
         channel != channels::kBodyState;
}

}  // namespace

Frames::Frames(const RobotConfig& robot)
    : fields_(frame_fields(robot)), trunk_(robot.legs), working_(fields_.size(), kNone) {
  for (const FrameField& field : fields_) {
    const bool known = field.channel.empty() || source_of(field.channel) != nullptr;
    if (!known) sources_.push_back({field.channel, comes_every_cycle(field.channel)});
  }
  const auto index = [&](const std::string& name) { return find_field(fields_, name); };
  for (const LegConfig& leg : robot.legs) {
    const std::string prefix = "legs." + leg.name + ".";
    legs_.push_back({make_leg_kinematics(leg), leg.joints, index(prefix + "estimated_foot_in_hip_m.x"),
                     index(prefix + "desired_foot_in_hip_m.x"),
                     index(prefix + "desired_joint_position_rad.x"), index(prefix + "control_mode")});
  }
  for (const JointConfig& joint : robot.joints)
    position_fields_.push_back(index("joints." + joint.name + ".estimated_position_rad"));
  true_position_ = index("truth.base_in_world_m.x");
  true_attitude_ = index("truth.base_quaternion_wxyz.w");
  attitude_ = index("body.estimated_quaternion_wxyz.w");
  velocity_ = index("body.estimated_velocity_m_s.x");
  height_ = index("body.estimated_height_m");
  odometry_ = index("odometry.estimated_position_in_world_m.x");
  odometry_attitude_ = index("odometry.estimated_quaternion_wxyz.w");
  trunk_field_ = index("trunk.x_m");
  ghost_field_ = static_cast<int>(fields_.size() - robot.joints.size());
}

Frames::Source* Frames::source_of(std::string_view channel) {
  const auto found = std::find_if(sources_.begin(), sources_.end(),
                                  [&](const Source& source) { return source.channel == channel; });
  return found == sources_.end() ? nullptr : &*found;
}

const Frame* Frames::add(std::string_view channel, const std::uint8_t* data, std::size_t size,
                         double time_s) {
  Source* const source = source_of(channel);
  if (source == nullptr) return nullptr;
  if (decoder_.open(data, size, message_) != fields::Fault::kNone) {
    ++source->not_decoded;
    return nullptr;
  }
  ++source->decoded;
  const std::optional<Stamp> stamp = message_.stamp();
  if (!stamp) return nullptr;
  const Frame* done = nullptr;
  if (message_.session() != session_) {
    done = finish();
    begin_session(message_.session());
  }
  if (!is_news(*source, *stamp)) return done;
  if (source->every_cycle && stamp->seq > seq_) {
    if (open_) done = finish();
    open_ = true;
    seq_ = stamp->seq;
    time_s_ = time_s;
  }
  read(*source);
  return done;
}

bool Frames::is_news(Source& source, const Stamp& stamp) {
  if (!source.every_cycle) return true;
  if (stamp.seq <= source.seq) return false;
  source.seq = stamp.seq;
  return true;
}

void Frames::begin_session(std::int64_t session) {
  session_ = session;
  seq_ = -1;
  last_time_s_.reset();
  for (Source& source : sources_) source.seq = -1;
  std::fill(working_.begin(), working_.end(), kNone);
  trunk_.reset();
}

const Frames::Shape& Frames::shape_of(const std::string& channel) {
  const auto known = shapes_.find(message_.layout());
  if (known != shapes_.end()) return known->second;
  Shape shape{message_.keep_layout(), {}};
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (fields_[i].channel != channel) continue;
    const int at = shape.layout->find(fields_[i].path);
    if (at != fields::Layout::kNone) shape.moves.emplace_back(at, static_cast<int>(i));
  }
  return shapes_.emplace(message_.layout(), std::move(shape)).first->second;
}

void Frames::read(const Source& source) {
  for (const auto& [from, to] : shape_of(source.channel).moves)
    working_[static_cast<std::size_t>(to)] = message_.number(
        message_.fields()[static_cast<std::size_t>(from)]);
}

const Frame* Frames::finish() {
  if (!open_) return nullptr;
  open_ = false;
  place_trunk();
  place_ghost();
  last_time_s_ = time_s_;
  done_.time_s = time_s_;
  done_.seq = seq_;
  done_.session = session_;
  done_.values.resize(working_.size());
  std::transform(working_.begin(), working_.end(), done_.values.begin(),
                 [](double value) { return static_cast<float>(value); });
  return &done_;
}

bool Frames::has_pose(const Frame& frame) const {
  return std::any_of(position_fields_.begin(), position_fields_.end(),
                     [&](int field) { return std::isfinite(frame.values[static_cast<std::size_t>(field)]); });
}

Eigen::Quaterniond Frames::quaternion(int field) const {
  return {value(field), value(field + 1), value(field + 2), value(field + 3)};
}

void Frames::place_trunk() {
  TrunkInput input{
      vector(true_position_), quaternion(true_attitude_), quaternion(attitude_),          vector(velocity_),
      value(height_),         vector(odometry_),          quaternion(odometry_attitude_), {}};
  for (const Leg& leg : legs_) input.foot_in_hip_m.push_back(vector(leg.foot));
  trunk_.update(input, last_time_s_ ? std::max(0.0, time_s_ - *last_time_s_) : 0.0);
  double* out = &working_[static_cast<std::size_t>(trunk_field_)];
  for (int i = 0; i < 3; ++i) *out++ = trunk_.position_m()[i];
  const Eigen::Quaterniond& attitude = trunk_.attitude();
  for (double part : {attitude.w(), attitude.x(), attitude.y(), attitude.z()}) *out++ = part;
  *out = static_cast<double>(trunk_.source());
}

std::optional<JointVector> Frames::desired_of(const Leg& leg) const {
  const double mode = value(leg.control_mode);
  if (mode == static_cast<double>(ControlMode::kJoint)) {
    const Eigen::Vector3d asked = vector(leg.desired_joint);
    return JointVector(asked.head(static_cast<Eigen::Index>(std::min<std::size_t>(3, leg.joints.size()))));
  }
  const bool placed = mode == static_cast<double>(ControlMode::kPosition) ||
                      mode == static_cast<double>(ControlMode::kCompliance);
  if (!placed || !leg.kinematics) return std::nullopt;
  JointVector near(static_cast<Eigen::Index>(leg.joints.size()));
  for (std::size_t i = 0; i < leg.joints.size(); ++i)
    near[static_cast<Eigen::Index>(i)] = value(position_fields_[static_cast<std::size_t>(leg.joints[i])]);
  const Eigen::Vector3d foot = vector(leg.desired_foot);
  if (!foot.allFinite() || !near.allFinite()) return std::nullopt;
  return leg.kinematics->inverse(foot, near).position_rad;
}

void Frames::place_ghost() {
  for (const Leg& leg : legs_) {
    const std::optional<JointVector> desired = desired_of(leg);
    for (std::size_t i = 0; i < leg.joints.size(); ++i) {
      const bool has = desired && static_cast<Eigen::Index>(i) < desired->size();
      working_[static_cast<std::size_t>(ghost_field_) +
               static_cast<std::size_t>(leg.joints[i])] = has ? (*desired)[static_cast<Eigen::Index>(i)]
                                                              : kNone;
    }
  }
}

}  // namespace sprung::station
