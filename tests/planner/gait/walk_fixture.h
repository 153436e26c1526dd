#pragma once
/// pegasus walking without physics: every foot is where it is wanted, unless the floor is in its way; the
/// trunk lies as it is wanted, goes as fast as it should, and hangs over the feet that stand as their springs
/// have it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "model/leg_kinematics.h"
#include "planner/gait/body_frame.h"
#include "planner/gait/walk.h"
#include "robots/robot_loader.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/vec3.h"

namespace sprung {

class WalkFixture : public testing::Test {
 protected:
  static constexpr double kStep_s = 0.002;

  explicit WalkFixture(const std::string& preset = "best") : preset_(robot_.preset(preset)) {
    for (std::size_t i = 0; i < 4; ++i) {
      place(i, walk_.stance_foot_in_hip_m(i, preset_.stand_length_m));
      in_.legs[i].contact = true;
    }
    in_.body.estimated_quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
    in_.body.estimated_angular_velocity_rad_s = {0.0, 0.0, 0.0};
    in_.body.estimated_velocity_m_s = {0.0, 0.0, 0.0};
    in_.body.estimated_height_m = preset_.stand_length_m;
    wanted_.resize(4);
  }
  int gait(const std::string& name) const {
    for (std::size_t i = 0; i < robot_.gaits.size(); ++i)
      if (robot_.gaits[i].name == name) return static_cast<int>(i);
    ADD_FAILURE() << "no gait " << name;
    return -1;
  }
  WalkRequest request(const std::string& name, const Vec3& speed = {0.0, 0.0, 0.0},
                      GaitControl control = GaitControl::kAdaptive) const {
    return {gait(name), speed, preset_.stand_length_m, preset_.walk.stance_width_m, control};
  }
  void begin(const WalkRequest& wanted) {
    ASSERT_EQ(walk_.validate(wanted, false), nullptr);
    walk_.begin(in_, wanted);
    look();
  }
  void change(const WalkRequest& wanted) {
    ASSERT_EQ(walk_.validate(wanted, true), nullptr);
    walk_.change(wanted);
  }
  void cycle() {
    in_.stamp.utime_us += 2000;
    ++in_.stamp.seq;
    walk_.step(in_);
    look();
    lie();
    height_m_ = height_m();
    for (std::size_t i = 0; i < 4; ++i) {
      Eigen::Vector3d foot_m = level_foot_m(i);
      const double floor_m = floor_m_[i] - height_m_;
      const bool stands = wanted_[i].phase == LegPhase::kStance;
      in_.legs[i].contact = stands || foot_m.z() <= floor_m + 1e-9;
      foot_m.z() = stands ? floor_m : std::max(foot_m.z(), floor_m);
      foot_m.x() += slipped_m_[i];
      place(i, to_vec3(level_from_trunk_.transpose() * foot_m - hip_m(i)));
    }
    in_.body.estimated_velocity_m_s = {motion_.desired_speed[0], motion_.desired_speed[1], 0.0};
  }
  /// @param each is called after every cycle.
  void run(
      double seconds, const std::function<void()>& each = [] {}) {
    for (int k = 0; k < static_cast<int>(seconds / kStep_s + 0.5) && !walk_.ended(); ++k) {
      cycle();
      each();
    }
  }
  void place(std::size_t leg, const Vec3& foot_in_hip_m) {
    in_.legs[leg].estimated_foot_in_hip_m = foot_in_hip_m;
  }
  /// As wanted at once: what has no mass has no lag.
  void lie() {
    const Attitude& trunk = walk_.wanted_trunk();
    level_from_trunk_ = level_from_trunk(trunk);
    const Eigen::Quaterniond q(
        Eigen::AngleAxisd(attitude(in_.body.estimated_quaternion_wxyz).yaw_rad, Eigen::Vector3d::UnitZ()) *
        level_from_trunk_);
    in_.body.estimated_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
  }
  Eigen::Vector3d hip_m(std::size_t leg) const { return to_eigen(robot_.legs[leg].hip_in_trunk_m); }
  /// As wanted, level axes.
  Eigen::Vector3d level_foot_m(std::size_t leg) const {
    return level_from_trunk_ * (hip_m(leg) + to_eigen(wanted_[leg].desired_foot_in_hip_m));
  }
  void look() {
    walk_.write(motion_);
    for (std::size_t i = 0; i < 4; ++i) {
      wanted_[i] = DesiredLeg{};
      walk_.write(i, wanted_[i]);
    }
  }
  /// Where the trunk comes to rest on the springs of the feet that stand.
  double height_m() const {
    double sum_m = 0.0;
    int feet = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (wanted_[i].phase != LegPhase::kStance) continue;
      sum_m += floor_m_[i] - level_foot_m(i).z();
      ++feet;
    }
    return feet == 0 ? height_m_ : sum_m / feet;
  }
  int standing() const {
    return static_cast<int>(std::count_if(wanted_.begin(), wanted_.end(),
                                          [](const DesiredLeg& l) { return l.phase == LegPhase::kStance; }));
  }
  /// Of the foot that is farthest from its place, over the ground.
  double place_error_m() const {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 place = walk_.stance_foot_in_hip_m(i, preset_.stand_length_m);
      const Vec3& foot = in_.legs[i].estimated_foot_in_hip_m;
      worst_m = std::max(worst_m, std::hypot(foot[0] - place[0], foot[1] - place[1]));
    }
    return worst_m;
  }
  std::int32_t count(LegEvent event) const {
    std::int32_t sum = 0;
    for (const MotionLeg& leg : motion_.legs) sum += leg.event_counts[static_cast<std::size_t>(event)];
    return sum;
  }

  const RobotConfig robot_ = load_robot("pegasus");
  const PresetConfig preset_;
  Walk walk_{robot_, preset_};
  JointState in_{12, 4};
  MotionState motion_{4};
  std::vector<DesiredLeg> wanted_;
  std::array<double, 4> floor_m_{};    ///< under each foot, over where the robot began
  std::array<double, 4> slipped_m_{};  ///< ahead of where each foot is wanted
  double height_m_ = preset_.stand_length_m;
  Eigen::Matrix3d level_from_trunk_ = Eigen::Matrix3d::Identity();
};

}  // namespace sprung
