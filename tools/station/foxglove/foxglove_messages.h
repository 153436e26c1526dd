#pragma once
/// Foxglove's own messages that its 3-D panel draws, as protocol buffers: foxglove.FrameTransforms,
/// JointStates and SceneUpdate (schemas.json has their definitions, from PyPI's foxglove-schemas-protobuf
/// 0.4.0); and two that Foxglove has none for, sprung.Wrenches and sprung.Imu (make-schemas). Pure.
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sprung::station {

using Rgba = std::array<double, 4>;

struct FoxgloveTransform {
  std::string parent, child;
  Eigen::Isometry3d pose;  ///< of the child's axes in the parent's
};

struct FoxgloveJoint {
  std::string name;
  double position_rad = 0.0, velocity_rad_s = 0.0, effort_Nm = 0.0;  ///< NaN = left out
};

/// What the ground does to a point foot: a force and no moment.
struct FootWrench {
  std::string leg, frame;
  Eigen::Vector3d position_m, force_N;  ///< in frame
};

/// A scene entity that is put together primitive by primitive, placed in its frame.
class FoxgloveEntity {
 public:
  /// @param locked it moves with its frame after the time of its message.
  FoxgloveEntity(const std::string& frame, const std::string& id, bool locked, std::uint64_t time_ns);

  void add_cube(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m, const Rgba& colour);
  void add_sphere(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m, const Rgba& colour);
  /// Along z.
  void add_cylinder(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m, const Rgba& colour);
  /// From `from` along `way`; nothing where that has no length.
  void add_arrow(const Eigen::Vector3d& from_m, const Eigen::Vector3d& way_m, double diameter_m,
                 const Rgba& colour);
  void add_triangles(const Eigen::Isometry3d& pose, const std::vector<float>& vertices_m,
                     const std::vector<int>& indices, const Rgba& colour);
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

std::string scene_update(const std::vector<FoxgloveEntity>& entities);
std::string frame_transforms(const std::vector<FoxgloveTransform>& transforms, std::uint64_t time_ns);
std::string foot_wrenches(const std::vector<FootWrench>& wrenches, std::uint64_t time_ns);
std::string imu_sample(const std::string& frame, const Eigen::Vector3d& angular_velocity_rad_s,
                       const Eigen::Vector3d& specific_force_m_s2, std::uint64_t time_ns);
std::string joint_states(const std::vector<FoxgloveJoint>& joints, std::uint64_t time_ns);

/// A FileDescriptorSet, "" where it is none of the five. @param name "foxglove.SceneUpdate"
std::string foxglove_schema(const std::string& name);

}  // namespace sprung::station
