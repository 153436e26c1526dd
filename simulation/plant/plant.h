#pragma once
/// The true mechanics of the robot: MuJoCo bodies, rail and contact, with the gears' friction and reflected
/// inertia. Values in, values out; the only allocation after construction is MuJoCo's own. Torques and angles
/// are joint space unless they say actuator.
#include <array>
#include <optional>
#include <vector>

#include "signals/simulation.h"
#include "signals/vec3.h"
#include "simulation/plant/elastic_gear.h"
#include "simulation/plant/gear_friction.h"
#include "simulation/plant/ground.h"
#include "simulation/plant/ground_contact.h"
#include "simulation/plant/imu_sensor.h"
#include "simulation/plant/plant_model.h"
#include "simulation/plant/presliding.h"

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
  /// From outside, about the joint's positive direction; kept until changed. Others are ignored.
  void push_joint(int joint, double torque_Nm) noexcept;
  /// Holds the base still. @param height_m of the base in the world; not above 0 = where it is.
  void suspend(double height_m) noexcept;
  /// At once, also under a foot: the contact's spring then pushes. reset() puts it back to sim.yaml's.
  /// @param leg under its foot alone; -1 = everywhere.
  void set_floor_height(double height_m, int leg = -1) noexcept;
  void release() noexcept;

  double step_s() const noexcept { return model_->opt.timestep; }
  double position_rad(std::size_t joint) const noexcept;
  double velocity_rad_s(std::size_t joint) const noexcept;
  /// Torque that holds the joint where it is, at rest and without friction; as of the last step.
  double load_Nm(std::size_t joint) const noexcept { return data_->qfrc_bias[index_.joint_dof[joint]]; }
  /// Of the rotor, output side; the joint's own where the gear has no torsion.
  double motor_position_rad(std::size_t joint) const noexcept;
  double motor_velocity_rad_s(std::size_t joint) const noexcept;
  double temperature_degC(std::size_t joint) const noexcept {
    return gears_[joint].friction.temperature_degC();
  }
  /// What the link feels, and friction, both in the last step (facts physics 8).
  double gear_output_torque_Nm(std::size_t joint) const noexcept;
  double friction_torque_Nm(std::size_t joint) const noexcept;
  /// Of a base on a free joint, now; at rest and level for every other.
  BaseMotion base_motion() const noexcept;
  /// All fields but the stamp. Allocates nothing when `truth` has the robot's counts.
  /// Leaves the next step's bits as they would be without it.
  void fill_truth(SimTruth& truth) noexcept;

  /// A MuJoCo warning or a number that is not finite: what the plant says from then on is void.
  bool failed() const noexcept { return failure_ != nullptr; }
  const char* failure() const noexcept { return failure_ == nullptr ? "" : failure_; }

 private:
  struct Gear {
    GearFriction friction;
    std::optional<ElasticGear> torsion{};
    std::optional<Presliding> presliding{};  ///< holds instead of MuJoCo's friction or the rotor's
    double ratio = 1.0;                      ///< turns of the motor for each of the gear's output
    double output_torque_Nm = 0.0;           ///< of `torsion`, in the last step
    double dry_Nm = 0.0;                     ///< friction that may act in this step
    double viscous_Nm_s_rad = 0.0;
    double viscous_Nm = 0.0;       ///< of a linkage's gear, in the last step
    double elastic_Nm = 0.0;       ///< friction of `presliding`, in the last step
    mutable int friction_row = 0;  ///< among MuJoCo's constraints, when it was last looked for
  };
  /// @throws ConfigError on friction that is too stiff for the step.
  Gear make_gear(const PlantJointConfig& joint) const;
  void note_ratios(const RobotConfig& robot) noexcept;
  void reset_gear(std::size_t joint) noexcept;
  void turn_trunk() noexcept;
  void touch_floor() noexcept;
  void note_feet() noexcept;
  Ground::Place below_trunk() const noexcept;
  UnevenFloor uneven_floor() const noexcept;
  void feel_patches() noexcept;
  void place_floors() noexcept;
  void place_floor(int geom, const Ground::Place& place) noexcept;
  void apply_torques() noexcept;
  void hold_elastically(std::size_t gear) noexcept;
  void step_rotors() noexcept;
  void strain_friction() noexcept;
  void heat_gears() noexcept;
  void refresh_poses() noexcept;
  mjtNum* base_armature() const noexcept;  ///< of the base's degrees of freedom, in the model
  void push_feet() noexcept;
  void update_friction() noexcept;
  void check() noexcept;
  /// nullptr where the gear turns with its joint alone.
  const Linkage* linkage_of(std::size_t gear) const noexcept;
  double gear_angle_rad(std::size_t gear) const noexcept;
  double gear_speed_rad_s(std::size_t gear) const noexcept;
  double gear_loss_Nm(std::size_t gear) const noexcept;
  double gear_load_Nm(std::size_t gear) const noexcept;
  double dry_friction_Nm(std::size_t joint) const noexcept;
  TrueJoint true_joint(std::size_t joint) const noexcept;
  /// Of the ground, world axes. @param met of geoms: whether it counts.
  template <class Met>
  Vec3 contact_force_N(Met met) const noexcept;

  PlantConfig config_;
  ModelPtr model_;
  PlantIndex index_;
  DataPtr data_;
  std::vector<double> motor_torque_Nm_;
  std::vector<double> push_Nm_;        ///< from outside, by joint
  std::vector<double> base_armature_;  ///< of the base's degrees of freedom, when not suspended
  std::vector<std::array<double, 6>> foot_wrench_;
  Ground ground_;
  /// Where the last step began: the same whether or not anybody asks for the truth.
  std::vector<Vec3> foot_m_;
  std::vector<Gear> gears_;
  bool varying_friction_ = false;  ///< of any gear: else what the model has from the start stays
  bool torsion_ = false;           ///< in any gear
  bool presliding_ = false;        ///< in any gear
  bool heating_ = false;
  const char* failure_ = nullptr;
};

}  // namespace sprung::sim
