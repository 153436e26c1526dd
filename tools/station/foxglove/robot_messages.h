#pragma once
/// A robot's frames as Foxglove's messages: what lets it stand in 3-D panels, from logs and live alike. Pure.
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/station/foxglove/foxglove_messages.h"
#include "tools/station/frames/frames.h"

namespace sprung::station {

enum class RobotTopic : std::uint8_t {
  kTransforms,   ///< of all bodies, world, and the trunk in it
  kShapes,       ///< each fixed to its body; the same at all times
  kForces,       ///< arrows at the feet: estimated, and the simulation's truth
  kJointStates,  ///< angle, speed, torque at the gear's output
  kWrenches,     ///< of the ground on each foot, estimated, in world
  kImu           ///< in trunk axes
};
inline constexpr std::array kRobotTopics{RobotTopic::kTransforms,  RobotTopic::kShapes,   RobotTopic::kForces,
                                         RobotTopic::kJointStates, RobotTopic::kWrenches, RobotTopic::kImu};
const char* name_of(RobotTopic topic) noexcept;  ///< "/tf"
const char* type_of(RobotTopic topic) noexcept;  ///< "foxglove.FrameTransforms", see foxglove_schema()

class RobotMessages {
 public:
  /// @param scene of that robot, scene.h; not null. @param fields of the frames that come.
  RobotMessages(const RobotConfig& robot, const nlohmann::json& scene, const std::vector<FrameField>& fields);

  /// @return "" where the frame has nothing of it: no IMU, no force.
  std::string message(RobotTopic topic, const Frame& frame, std::uint64_t time_ns) const;
  std::string shapes(std::uint64_t time_ns) const;
  /// Of each body in its parent, the first in "world". A joint whose angle nobody tells stays where model.xml
  /// has it; a trunk whose pose nobody tells likewise.
  std::vector<FoxgloveTransform> transforms(const Frame& frame) const;

 private:
  /// One body, and where it is in its parent at each angle of its joint.
  struct Link {
    std::string name;
    int parent = -1;
    Eigen::Isometry3d rest;
    int position_field = -1;  ///< of the joint's angle; -1 = it does not turn
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX(), anchor_m = Eigen::Vector3d::Zero();
    double zero_rad = 0.0;

    Eigen::Isometry3d at(double angle_rad) const;
  };
  struct Foot {
    std::string leg;
    int body = 0;
    Eigen::Vector3d in_body_m = Eigen::Vector3d::Zero();
    int force_field = -1, true_force_field = -1, contact_field = -1;
  };
  struct Joint {
    std::string name;
    int position = -1, velocity = -1, torque = -1;
  };

  Link link_of(const nlohmann::json& body, std::size_t index, const std::vector<FrameField>& fields) const;
  Eigen::Isometry3d trunk(const Frame& frame) const;
  Eigen::Isometry3d in_parent(const Frame& frame, std::size_t body) const;
  Eigen::Isometry3d in_world(const Frame& frame, int body) const;
  /// In world; NaN where it is not known, or the foot is in the air.
  Eigen::Vector3d ground_force_N(const Frame& frame, const Foot& foot) const;
  std::string forces(const Frame& frame, std::uint64_t time_ns) const;
  std::string joints(const Frame& frame, std::uint64_t time_ns) const;
  std::string wrenches(const Frame& frame, std::uint64_t time_ns) const;
  std::string imu(const Frame& frame, std::uint64_t time_ns) const;

  std::vector<Link> links_;
  std::vector<Foot> feet_;
  std::vector<Joint> joints_;
  std::size_t base_ = 0;
  bool base_fixed_ = false;
  int trunk_field_ = -1, turning_field_ = -1, specific_force_field_ = -1;
  std::shared_ptr<const nlohmann::json> scene_;
};

}  // namespace sprung::station
