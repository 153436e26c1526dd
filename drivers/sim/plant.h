#pragma once
/// The true mechanics of the robot: MuJoCo bodies, rail and contact, with the gears' friction and reflected
/// inertia. Values in, values out; the only allocation after construction is MuJoCo's own. Torques and angles
/// are joint space unless they say actuator.
#include <array>
#include <vector>

#include "drivers/sim/plant_model.h"
#include "signals/signals.h"

namespace sprung::sim {

class Plant {
 public:
  /// @throws ConfigError
  Plant(const RobotConfig& robot, const PlantConfig& config);

  /// Initial pose of sim.yaml at rest, the lowest foot just touching the floor; the same bits every time.
  void reset() noexcept;
  /// One step. @param motor_torque_Nm after the gear ratio, before friction and rotor inertia; one for each
  /// joint.
  void step(const std::vector<double>& motor_torque_Nm) noexcept;

  /// Force and torque at the base's centre of mass, world axes; kept until changed.
  void set_base_wrench(const std::array<double, 6>& wrench) noexcept;
  /// The same at the foot of a leg.
  void set_foot_wrench(int leg, const std::array<double, 6>& wrench) noexcept;
  /// Holds the base still. @param height_m of the base in the world; not above 0 = where it is.
  void suspend(double height_m) noexcept;
  /// At once, also under a foot: the contact's spring then pushes. reset() puts it back to sim.yaml's.
  void set_floor_height(double height_m) noexcept;
  void release() noexcept;

  double step_s() const noexcept { return model_->opt.timestep; }
  double position_rad(std::size_t joint) const noexcept;
  double velocity_rad_s(std::size_t joint) const noexcept;
  /// What the link feels, and friction, both in the last step (facts physics 8).
  double gear_output_torque_Nm(std::size_t joint) const noexcept;
  double friction_torque_Nm(std::size_t joint) const noexcept;
  /// All fields but the stamp. Allocates nothing when `truth` has the robot's counts.
  /// Leaves the next step's bits as they would be without it.
  void fill_truth(SimTruth& truth) noexcept;

  /// A MuJoCo warning or a number that is not finite: what the plant says from then on is void.
  bool failed() const noexcept { return failure_ != nullptr; }
  const char* failure() const noexcept { return failure_ == nullptr ? "" : failure_; }

 private:
  void touch_floor() noexcept;
  void refresh_poses() noexcept;
  void push_feet() noexcept;
  void update_friction() noexcept;
  void check() noexcept;
  double solver_friction_Nm(int dof) const noexcept;
  Vec3 contact_force_N(int geom) const noexcept;  ///< ground on foot, world axes

  PlantConfig config_;
  ModelPtr model_;
  PlantIndex index_;
  DataPtr data_;
  std::vector<double> motor_torque_Nm_;
  std::vector<double> base_armature_;  ///< of the base's degrees of freedom, when not suspended
  std::vector<std::array<double, 6>> foot_wrench_;
  bool varying_friction_ = false;  ///< friction depends on speed or load
  const char* failure_ = nullptr;
};

}  // namespace sprung::sim
