#pragma once
/// Where each body of the robot is, for viewers that draw frames. Pure.
#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/station/frames/frames.h"

namespace sprung::station {

class Transforms {
 public:
  /// @param scene as scene.h makes it; one that is missing has no bodies, and no transforms.
  Transforms(const nlohmann::json& scene, const std::vector<FrameField>& fields);

  /// foxglove.FrameTransforms, JSON: every body in its parent's axes, the first in "world". A joint whose
  /// angle nobody tells stays where model.xml has it; a trunk whose pose nobody tells likewise.
  std::string json(const Frame& frame, std::int64_t time_ns) const;

 private:
  struct Body {
    std::string name, parent;
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
    int angle_field = -1;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX(), anchor_m = Eigen::Vector3d::Zero();
    double zero_rad = 0.0;
  };
  void place(const Body& body, const Frame& frame, Eigen::Vector3d& position_m,
             Eigen::Quaterniond& attitude) const;

  std::vector<Body> bodies_;
  int base_ = -1;  ///< body that trunk.* places; -1: it is fixed
  int trunk_field_ = -1;
};

}  // namespace sprung::station
