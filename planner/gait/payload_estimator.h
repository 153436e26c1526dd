#pragma once
/// What the trunk carries beyond robot.yaml's masses, and where the robot's centre of mass is with it: from
/// what the feet press. Pure: no heap.
///
/// Joints at rest hide kilograms in their gears' stiction, so a robot is weighed while its joints move: over
/// the rise from its belly to standing, and then over each whole period of a gait, in which friction of both
/// directions cancels. Over such times the forces' mean is the weight plus the change of momentum, and the
/// middle of pressure is below the centre of mass but for what the change along the ground shifts it. Level
/// axes count for trunk axes: they differ by the trunk's tilt.
#include <Eigen/Core>

#include "planner/gait/body_view.h"
#include "signals/motion_state.h"

namespace sprung {

class PayloadEstimator {
 public:
  explicit PayloadEstimator(const RobotConfig& robot)
      : shape_(robot), least_height_m_(robot.body.fallen_height_m) {}

  /// Nothing is known any more: before a rise.
  void forget() noexcept;
  void add_rise(const JointState& in) noexcept { add(in, BodyView::of(in, shape_)); }
  /// One cycle of a gait. @param view of the same cycle.
  void add(const JointState& in, const BodyView& view) noexcept;
  /// What was added since then was a whole rise; @return false: it could not be weighed.
  bool rise_ended() noexcept;
  /// The same of a gait's period.
  bool period_ended() noexcept;
  /// What was added since then is neither: a gait that began, or waited.
  void begin_anew() noexcept { window_ = Window{}; }

  EstimatedPayload estimate() const noexcept;
  /// For laws: mass beyond its bound, and all of the shift.
  LoadOnTrunk used() const noexcept;

 private:
  struct Window {
    double time_s = 0.0;
    double impulse_Ns = 0.0;                               ///< vertical, of all feet
    double bound_Ns = 0.0;                                 ///< of it, at about 95 %
    Eigen::Vector2d moment_Nms = Eigen::Vector2d::Zero();  ///< of it, about the middle of the hips
    Eigen::Vector2d com_ms = Eigen::Vector2d::Zero();      ///< robot.yaml's centre of mass, times time
    double height_ms = 0.0;                               ///< of the centre of mass over the feet, times time
    Eigen::Vector3d began_m_s = Eigen::Vector3d::Zero();  ///< the trunk's speed
    Eigen::Vector3d ends_m_s = Eigen::Vector3d::Zero();
    std::int64_t last_us = 0;
  };
  struct Weight {
    double mass_kg = 0.0;  ///< of all
    double bound_kg = 0.0;
    Eigen::Vector2d com_m = Eigen::Vector2d::Zero();        ///< robot.yaml's, from the middle of the hips
    Eigen::Vector2d com_shift_m = Eigen::Vector2d::Zero();  ///< from there
  };
  bool weigh(Weight& out) const noexcept;

  BodyShape shape_;        ///< without a load
  double least_height_m_;  ///< lower the trunk may lie on the ground
  Window window_;
  bool known_ = false;
  Weight now_;
};

}  // namespace sprung
