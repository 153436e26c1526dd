/// What can be asked of the plant.
#include <algorithm>

#include "simulation/plant/linkage.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/plant.h"

namespace sprung::sim {

double Plant::position_rad(std::size_t joint) const noexcept { return data_->qpos[index_.joint_qpos[joint]]; }

double Plant::velocity_rad_s(std::size_t joint) const noexcept {
  return data_->qvel[index_.joint_dof[joint]];
}

double Plant::motor_position_rad(std::size_t joint) const noexcept {
  const Gear& gear = gears_[joint];
  return gear.torsion ? gear.torsion->position_rad() : position_rad(joint);
}

double Plant::motor_velocity_rad_s(std::size_t joint) const noexcept {
  const Gear& gear = gears_[joint];
  return gear.torsion ? gear.torsion->velocity_rad_s() : velocity_rad_s(joint);
}

const Linkage* Plant::linkage_of(std::size_t gear) const noexcept {
  for (const Linkage& linkage : index_.linkages) {
    if (linkage.gear == gear) return &linkage;
  }
  return nullptr;
}

/// Of the motor side, after the ratio.
double Plant::gear_angle_rad(std::size_t gear) const noexcept {
  const Linkage* linkage = linkage_of(gear);
  if (linkage == nullptr) return motor_position_rad(gear);
  double sum_rad = 0.0;
  for (const Linkage::Part& part : linkage->parts) sum_rad += part.share * position_rad(part.joint);
  return sum_rad;
}

double Plant::gear_speed_rad_s(std::size_t gear) const noexcept {
  const Linkage* linkage = linkage_of(gear);
  return linkage != nullptr ? linkage->of_motor(data_->qvel) : motor_velocity_rad_s(gear);
}

double Plant::dry_friction_Nm(std::size_t joint) const noexcept {
  if (gears_[joint].presliding) return gears_[joint].elastic_Nm;
  if (gears_[joint].torsion) return gears_[joint].torsion->dry_friction_Nm();
  const Linkage* linkage = linkage_of(joint);
  const int type = linkage != nullptr ? mjCNSTR_FRICTION_TENDON : mjCNSTR_FRICTION_DOF;
  const int id = linkage != nullptr ? linkage->tendon : index_.joint_dof[joint];
  const int guess = gears_[joint].friction_row;  // rows of friction come first, in the order of the joints:
                                                 // mostly the same
  const auto is_it = [&](int row) { return data_->efc_type[row] == type && data_->efc_id[row] == id; };
  if (guess < data_->nefc && is_it(guess)) return -data_->efc_force[guess];
  for (int row = 0; row < data_->nefc; ++row) {
    if (!is_it(row)) continue;
    gears_[joint].friction_row = row;
    return -data_->efc_force[row];
  }
  return 0.0;
}

double Plant::friction_torque_Nm(std::size_t joint) const noexcept {
  if (gears_[joint].torsion) return gears_[joint].torsion->friction_torque_Nm() + gears_[joint].elastic_Nm;
  if (linkage_of(joint) != nullptr) return dry_friction_Nm(joint) + gears_[joint].viscous_Nm;
  return dry_friction_Nm(joint) - data_->qfrc_passive[index_.joint_dof[joint]];
}

/// What rotor and friction take of a motor's torque.
double Plant::gear_loss_Nm(std::size_t gear) const noexcept {
  const Linkage* linkage = linkage_of(gear);
  const double acceleration = linkage != nullptr ? linkage->of_motor(data_->qacc)
                                                 : data_->qacc[index_.joint_dof[gear]];
  return config_.joints[gear].armature_kg_m2 * acceleration + friction_torque_Nm(gear);
}

double Plant::gear_output_torque_Nm(std::size_t joint) const noexcept {
  if (gears_[joint].torsion) return gears_[joint].output_torque_Nm;
  double output_Nm = motor_torque_Nm_[joint];
  if (linkage_of(joint) == nullptr) output_Nm -= gear_loss_Nm(joint);
  for (const Linkage& linkage : index_.linkages) {
    for (const Linkage::Part& part : linkage.parts) {
      if (part.joint == joint) output_Nm -= part.share * gear_loss_Nm(linkage.gear);
    }
  }
  return output_Nm;
}

/// Torque of one gear on what it drives: of its joint, without what other gears' linkages bring there.
double Plant::gear_load_Nm(std::size_t gear) const noexcept {
  if (const Linkage* linkage = linkage_of(gear)) return gear_output_torque_Nm(gear) / linkage->own().share;
  double load_Nm = gear_output_torque_Nm(gear);
  for (const Linkage& linkage : index_.linkages) {
    for (const Linkage::Part& part : linkage.parts) {
      if (part.joint == gear) load_Nm -= part.share * gear_load_Nm(linkage.gear);
    }
  }
  return load_Nm;
}

TrueJoint Plant::true_joint(std::size_t joint) const noexcept {
  TrueJoint truth;
  truth.true_position_rad = position_rad(joint);
  truth.true_velocity_rad_s = velocity_rad_s(joint);
  truth.true_acceleration_rad_s2 = data_->qacc[index_.joint_dof[joint]];
  truth.true_motor_torque_Nm = motor_torque_Nm_[joint];
  truth.true_gear_output_torque_Nm = gear_output_torque_Nm(joint);
  truth.true_friction_torque_Nm = friction_torque_Nm(joint);
  truth.true_motor_position_rad = motor_position_rad(joint);
  if (gears_[joint].friction.has_temperature()) truth.true_temperature_degC = temperature_degC(joint);
  return truth;
}

BaseMotion Plant::base_motion() const noexcept {
  BaseMotion motion;
  if (index_.free_qpos < 0) return motion;
  const mjtNum* orientation = data_->qpos + index_.free_qpos + 3;
  std::copy(orientation, orientation + 4, motion.quaternion_wxyz.begin());
  motion.velocity_m_s = vec3(data_->qvel + index_.free_dof);
  motion.angular_velocity_rad_s = vec3(data_->qvel + index_.free_dof + 3);  // MuJoCo: in the body's own axes
  return motion;
}

template <class Met>
Vec3 Plant::contact_force_N(Met met) const noexcept {
  Vec3 sum{};
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    if (!met(contact.geom2)) continue;
    mjtNum force[6];
    mj_contactForce(model_.get(), data_.get(), i, force);
    mjtNum world[3];
    mju_rotVecMatT(world, force, contact.frame);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += world[axis];
  }
  return sum;
}

void Plant::fill_truth(SimTruth& truth) noexcept {
  const BaseMotion motion = base_motion();
  refresh_poses();
  if (index_.free_qpos >= 0)  // mj_kinematics has normalised it, which may change its last bit
    std::copy(motion.quaternion_wxyz.begin(), motion.quaternion_wxyz.end(),
              data_->qpos + index_.free_qpos + 3);
  for (std::size_t i = 0; i < gears_.size(); ++i) truth.joints[i] = true_joint(i);
  for (std::size_t leg = 0; leg < index_.foot_geom.size(); ++leg) {
    const int geom = index_.foot_geom[leg];
    truth.legs[leg].true_foot_in_world_m = vec3(row(data_->geom_xpos, geom, 3));
    truth.legs[leg].true_contact_force_N = contact_force_N([geom](int met) { return met == geom; });
    const Vec3& foot_m = truth.legs[leg].true_foot_in_world_m;
    truth.legs[leg].true_ground_height_m = ground_.under(leg, foot_m[0], foot_m[1]).point_m[2];
  }
  const int base = index_.base_body;
  truth.true_base_contact_force_N = contact_force_N(
      [this](int met) { return model_->geom_bodyid[met] == index_.base_body; });
  mjtNum velocity[6];
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, base, velocity, 0);
  truth.base_in_world_m = vec3(row(data_->xpos, base, 3));
  truth.base_velocity_m_s = vec3(velocity + 3);
  truth.base_angular_velocity_rad_s = motion.angular_velocity_rad_s;
  mj_subtreeVel(model_.get(), data_.get());
  truth.com_in_world_m = vec3(row(data_->subtree_com, base, 3));
  truth.com_velocity_m_s = vec3(row(data_->subtree_linvel, base, 3));
  std::copy(row(data_->xquat, base, 4), row(data_->xquat, base, 4) + 4, truth.base_quaternion_wxyz.begin());
}

}  // namespace sprung::sim
