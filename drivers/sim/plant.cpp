#include "drivers/sim/plant.h"

#include <algorithm>
#include <cmath>

#include "drivers/sim/mujoco_row.h"

namespace sprung::sim {
namespace {

/// Such friction is written into the model at every step; plain Coulomb friction once, at load.
bool depends_on_motion(const FrictionConfig& friction) noexcept {
  return friction.load_share > 0.0 || friction.breakaway_Nm > friction.coulomb_Nm;
}

const char* warning_name(int warning) noexcept {
  switch (warning) {
    case mjWARN_INERTIA:
      return "MuJoCo: inertia matrix is singular";
    case mjWARN_CONTACTFULL:
      return "MuJoCo: contact buffer is full";
    case mjWARN_CNSTRFULL:
      return "MuJoCo: constraint buffer is full";
    case mjWARN_BADQPOS:
      return "MuJoCo: position is not finite or huge";
    case mjWARN_BADQVEL:
      return "MuJoCo: velocity is not finite or huge";
    case mjWARN_BADQACC:
      return "MuJoCo: acceleration is not finite or huge";
    case mjWARN_BADCTRL:
      return "MuJoCo: control is not finite";
    default:
      return "MuJoCo: warning";
  }
}

Vec3 vec3(const mjtNum* values) noexcept { return {values[0], values[1], values[2]}; }

}  // namespace

Plant::Plant(const RobotConfig& robot, const PlantConfig& config)
    : config_(config), motor_torque_Nm_(robot.joints.size(), 0.0), foot_wrench_(robot.legs.size()) {
  PlantModel loaded = load_plant_model(robot, config);
  model_ = std::move(loaded.model);
  index_ = std::move(loaded.index);
  data_.reset(mj_makeData(model_.get()));
  const int first_dof = model_->body_dofadr[index_.base_body];
  base_armature_.assign(model_->dof_armature + first_dof,
                        model_->dof_armature + first_dof + model_->body_dofnum[index_.base_body]);
  for (const PlantJointConfig& joint : config.joints) {
    varying_friction_ = varying_friction_ || depends_on_motion(joint.friction);
  }
  reset();
}

void Plant::reset() noexcept {
  release();
  set_floor_height(config_.floor_height_m);
  mj_resetData(model_.get(), data_.get());
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    data_->qpos[index_.joint_qpos[i]] = config_.joints[i].initial_rad;
  }
  std::fill(motor_torque_Nm_.begin(), motor_torque_Nm_.end(), 0.0);
  for (auto& wrench : foot_wrench_) wrench.fill(0.0);
  touch_floor();
  if (config_.suspended_m > 0.0) suspend(config_.suspended_m);
  mj_forward(model_.get(), data_.get());
  mju_zero(data_->qacc_warmstart, model_->nv);  // else a second life differs in its bits: facts physics 7
  check();
}

void Plant::set_floor_height(double height_m) noexcept {
  row(model_->geom_pos, index_.floor_geom, 3)[2] = height_m;
}

void Plant::touch_floor() noexcept {
  mj_kinematics(model_.get(), data_.get());
  double lowest_m = mjMAXVAL;
  for (const int geom : index_.foot_geom) {
    lowest_m = std::min(lowest_m, row(data_->geom_xpos, geom, 3)[2] - row(model_->geom_size, geom, 3)[0]);
  }
  data_->qpos[index_.height_qpos] += config_.floor_height_m - lowest_m;
}

void Plant::step(const std::vector<double>& motor_torque_Nm) noexcept {
  if (failed()) return;
  std::copy(motor_torque_Nm.begin(), motor_torque_Nm.end(), motor_torque_Nm_.begin());
  mju_zero(data_->qfrc_applied, model_->nv);
  for (std::size_t i = 0; i < index_.joint_dof.size(); ++i) {
    data_->qfrc_applied[index_.joint_dof[i]] = motor_torque_Nm_[i];
  }
  push_feet();
  if (varying_friction_) update_friction();
  mj_step(model_.get(), data_.get());
  check();
}

/// mj_step leaves bodies where they were before it integrated; this brings them to the joints' present
/// values.
void Plant::refresh_poses() noexcept {
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  mj_comVel(model_.get(), data_.get());
}

void Plant::push_feet() noexcept {
  const auto pushes = [](const std::array<double, 6>& wrench) {
    return std::any_of(wrench.begin(), wrench.end(), [](double part) { return part != 0.0; });
  };
  if (std::none_of(foot_wrench_.begin(), foot_wrench_.end(), pushes)) return;
  refresh_poses();
  for (std::size_t leg = 0; leg < foot_wrench_.size(); ++leg) {
    const int geom = index_.foot_geom[leg];
    mj_applyFT(model_.get(), data_.get(), foot_wrench_[leg].data(), foot_wrench_[leg].data() + 3,
               row(data_->geom_xpos, geom, 3), model_->geom_bodyid[geom], data_->qfrc_applied);
  }
}

/// Facts physics 2: writing the friction every step is stable and still sticks.
void Plant::update_friction() noexcept {
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    const FrictionConfig& friction = config_.joints[i].friction;
    const double speed = velocity_rad_s(i) / friction.stribeck_speed_rad_s;
    const double stribeck_Nm = (friction.breakaway_Nm - friction.coulomb_Nm) * std::exp(-speed * speed);
    const double load_Nm = friction.load_share * std::abs(gear_output_torque_Nm(i));
    model_->dof_frictionloss[index_.joint_dof[i]] = friction.coulomb_Nm + stribeck_Nm + load_Nm;
  }
}

void Plant::check() noexcept {
  for (int warning = 0; warning < mjNWARNING; ++warning) {
    if (data_->warning[warning].number > 0) failure_ = warning_name(warning);
  }
}

void Plant::set_base_wrench(const std::array<double, 6>& wrench) noexcept {
  std::copy(wrench.begin(), wrench.end(), row(data_->xfrc_applied, index_.base_body, 6));
}

void Plant::set_foot_wrench(int leg, const std::array<double, 6>& wrench) noexcept {
  if (leg >= 0 && leg < static_cast<int>(foot_wrench_.size())) {
    foot_wrench_[static_cast<std::size_t>(leg)] = wrench;
  }
}

void Plant::suspend(double height_m) noexcept {
  const int first = model_->body_dofadr[index_.base_body];
  for (std::size_t i = 0; i < base_armature_.size(); ++i) {
    model_->dof_armature[first + static_cast<int>(i)] = kLockedMass;
    data_->qvel[first + static_cast<int>(i)] = 0.0;
  }
  mj_kinematics(model_.get(), data_.get());  // positions may be newer than poses
  if (height_m > 0.0) data_->qpos[index_.height_qpos] += height_m - row(data_->xpos, index_.base_body, 3)[2];
  mj_forward(model_.get(), data_.get());
}

void Plant::release() noexcept {
  std::copy(base_armature_.begin(), base_armature_.end(),
            model_->dof_armature + model_->body_dofadr[index_.base_body]);
}

double Plant::position_rad(std::size_t joint) const noexcept { return data_->qpos[index_.joint_qpos[joint]]; }

double Plant::velocity_rad_s(std::size_t joint) const noexcept {
  return data_->qvel[index_.joint_dof[joint]];
}

double Plant::solver_friction_Nm(int dof) const noexcept {
  for (int row = 0; row < data_->nefc; ++row) {
    if (data_->efc_type[row] == mjCNSTR_FRICTION_DOF && data_->efc_id[row] == dof)
      return -data_->efc_force[row];
  }
  return 0.0;
}

double Plant::friction_torque_Nm(std::size_t joint) const noexcept {
  const int dof = index_.joint_dof[joint];
  return solver_friction_Nm(dof) - data_->qfrc_passive[dof];
}

double Plant::gear_output_torque_Nm(std::size_t joint) const noexcept {
  const int dof = index_.joint_dof[joint];
  return motor_torque_Nm_[joint] - config_.joints[joint].armature_kg_m2 * data_->qacc[dof] -
         friction_torque_Nm(joint);
}

void Plant::fill_truth(SimTruth& truth) noexcept {
  refresh_poses();
  for (std::size_t i = 0; i < index_.joint_dof.size(); ++i) {
    truth.joints[i] = {position_rad(i),     velocity_rad_s(i),        data_->qacc[index_.joint_dof[i]],
                       motor_torque_Nm_[i], gear_output_torque_Nm(i), friction_torque_Nm(i)};
  }
  for (std::size_t leg = 0; leg < index_.foot_geom.size(); ++leg) {
    const int geom = index_.foot_geom[leg];
    truth.legs[leg].true_foot_in_world_m = vec3(row(data_->geom_xpos, geom, 3));
    truth.legs[leg].true_contact_force_N = contact_force_N(geom);
  }
  const int base = index_.base_body;
  mjtNum velocity[6];
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, base, velocity, 0);
  truth.base_in_world_m = vec3(row(data_->xpos, base, 3));
  truth.base_velocity_m_s = vec3(velocity + 3);
  std::copy(row(data_->xquat, base, 4), row(data_->xquat, base, 4) + 4, truth.base_quaternion_wxyz.begin());
}

Vec3 Plant::contact_force_N(int geom) const noexcept {
  Vec3 sum{};
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    if (contact.geom2 != geom) continue;
    mjtNum force[6];
    mj_contactForce(model_.get(), data_.get(), i, force);
    mjtNum world[3];
    mju_rotVecMatT(world, force, contact.frame);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += world[axis];
  }
  return sum;
}

}  // namespace sprung::sim
