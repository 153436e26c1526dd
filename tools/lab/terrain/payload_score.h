#pragma once
/// How far the stack's estimate of a payload is from the truth: all mass beyond robot.yaml's, and how far it
/// moves the robot's centre of mass. Pure but for what it reads of the robot.
#include <Eigen/Core>

#include "planner/gait/body_view.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {

class PayloadScore {
 public:
  explicit PayloadScore(const RobotConfig& robot) : shape_(robot) {}

  /// Each cycle in which the feet carry the robot, and nothing else does.
  void add(InProcessRobot& robot);

  /// |estimated - true|; NaN: nothing was estimated.
  double mass_off_kg(const EstimatedPayload& said) const;
  /// In the plane, of the centre of mass; NaN where no place was said.
  double com_off_m(const EstimatedPayload& said) const;

 private:
  double mass_kg() const;

  const BodyShape shape_;  ///< without a load
  double cycles_ = 0.0;
  Eigen::Vector2d com_m_ = Eigen::Vector2d::Zero();    ///< the same of robot.yaml's centre of mass
  double force_N_ = 0.0;                               ///< sum over cycles: vertical, of all feet
  Eigen::Vector2d shift_m_ = Eigen::Vector2d::Zero();  ///< the same: true centre of mass from robot.yaml's
};

}  // namespace sprung
