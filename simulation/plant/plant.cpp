#include "simulation/plant/plant.h"

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/linkage.h"
#include "simulation/plant/mujoco_row.h"

namespace sprung::sim {
namespace {

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

}  // namespace

Plant::Plant(const RobotConfig& robot, const PlantConfig& config)
    : config_(config),
      motor_torque_Nm_(robot.joints.size(), 0.0),
      push_Nm_(robot.joints.size(), 0.0),
      foot_wrench_(robot.legs.size()),
      ground_(config.ground, config.floor_height_m, robot.legs.size()),
      foot_m_(robot.legs.size()) {
  PlantModel loaded = load_plant_model(robot, config);
  model_ = std::move(loaded.model);
  index_ = std::move(loaded.index);
  if (config.roll_rad != 0.0 && index_.free_qpos < 0)
    throw ConfigError("--plant roll: this robot's trunk is not free to roll");
  data_.reset(mj_makeData(model_.get()));
  const mjtNum* first = base_armature();
  base_armature_.assign(first, first + model_->body_dofnum[index_.base_body]);
  for (const PlantJointConfig& joint : config.joints) {
    const Gear gear = make_gear(joint);
    torsion_ = torsion_ || gear.torsion;
    presliding_ = presliding_ || gear.presliding;
    varying_friction_ = varying_friction_ || gear.torsion || gear.friction.varies();
    heating_ = heating_ || gear.friction.heats();
    gears_.push_back(gear);
  }
  note_ratios(robot);
  reset();
}

Plant::Gear Plant::make_gear(const PlantJointConfig& joint) const {
  Gear gear{GearFriction(joint.friction, joint.thermal, config_.ambient_degC)};
  if (config_.torsion && joint.torsion) gear.torsion.emplace(*joint.torsion, joint.armature_kg_m2);
  const FrictionConfig& friction = joint.friction;
  if (friction.presliding_rad <= 0.0 || friction.breakaway_Nm <= 0.0) return gear;
  gear.presliding.emplace(friction.breakaway_Nm, friction.presliding_rad, joint.armature_kg_m2);
  const double stiffest = Presliding::kStiffest * joint.armature_kg_m2 / (step_s() * step_s());
  if (gear.presliding->stiffness_Nm_rad() > stiffest)
    throw ConfigError(
        joint.name + ": friction that slides after " + std::to_string(1e3 * friction.presliding_rad) +
        " mrad is too stiff for a step of " + std::to_string(1e6 * step_s()) +
        " us: make `presliding` longer, or 0 for friction that holds rigidly, or the step shorter");
  return gear;
}

/// A gear's own motor stands in the same place of its leg's list.
void Plant::note_ratios(const RobotConfig& robot) noexcept {
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t i = 0; i < std::min(leg.joints.size(), leg.actuators.size()); ++i)
      gears_[leg.joints[i]].ratio = robot.actuators[leg.actuators[i]].gear_ratio;
  }
}

void Plant::reset() noexcept {
  release();
  ground_.reset();
  mj_resetData(model_.get(), data_.get());
  for (std::size_t i = 0; i < config_.joints.size(); ++i) {
    data_->qpos[index_.joint_qpos[i]] = config_.joints[i].initial_rad;
    reset_gear(i);
  }
  std::fill(motor_torque_Nm_.begin(), motor_torque_Nm_.end(), 0.0);
  for (auto& wrench : foot_wrench_) wrench.fill(0.0);
  touch_floor();
  if (config_.suspended_m > 0.0) suspend(config_.suspended_m);
  const UnevenFloor floor = uneven_floor();
  mj_forward(model_.get(), data_.get());
  mju_zero(data_->qacc_warmstart, model_->nv);  // else a second life differs in its bits: facts physics 7
  check();
}

/// Cold, with the friction that the model was loaded with: else a second life differs in its bits.
void Plant::reset_gear(std::size_t joint) noexcept {
  Gear& gear = gears_[joint];
  const PlantJointConfig& config = config_.joints[joint];
  gear.friction.reset();
  gear.output_torque_Nm = 0.0;
  gear.viscous_Nm_s_rad = config.friction.viscous_Nm_s_rad;
  gear.viscous_Nm = gear.elastic_Nm = 0.0;
  if (gear.presliding) gear.presliding->reset();
  if (gear.torsion) return gear.torsion->reset(config.initial_rad);
  if (const Linkage* linkage = linkage_of(joint)) {
    model_->tendon_frictionloss[linkage->tendon] = gear.presliding ? 0.0 : config.friction.breakaway_Nm;
    return;
  }
  model_->dof_frictionloss[index_.joint_dof[joint]] = gear.presliding ? 0.0 : config.friction.breakaway_Nm;
  model_->dof_damping[index_.joint_dof[joint]] = config.friction.viscous_Nm_s_rad;
}

void Plant::set_floor_height(double height_m, int leg) noexcept {
  ground_.set_height(leg, height_m);
  place_floors();
}

void Plant::place_floor(int geom, const Ground::Place& place) noexcept {
  std::copy(place.point_m.begin(), place.point_m.end(), row(model_->geom_pos, geom, 3));
  mju_quatZ2Vec(row(model_->geom_quat, geom, 4), place.normal.data());
}

/// After mj_kinematics.
Ground::Place Plant::below_trunk() const noexcept {
  const Vec3 trunk_m = vec3(row(data_->xpos, index_.base_body, 3));
  return ground_.below(trunk_m[0], trunk_m[1]);
}

/// Spheres that are no feet meet the ground below each of them (UnevenFloor): for them the plane only has to
/// be so high that MuJoCo leaves none out for being above it. Other shapes meet the plane itself, the ground
/// below the trunk.
void Plant::place_floors() noexcept {
  constexpr double kHigh_m = 10.0;
  Ground::Place floor = below_trunk();
  if (ground_.uneven() && !index_.others_meet_floor)
    floor = {{floor.point_m[0], floor.point_m[1], floor.point_m[2] + kHigh_m}};
  place_floor(index_.floor_geom, floor);
  for (std::size_t leg = 0; leg < foot_m_.size(); ++leg)
    place_floor(index_.leg_floor_geom[leg], ground_.under(leg, foot_m_[leg][0], foot_m_[leg][1]));
}

UnevenFloor Plant::uneven_floor() const noexcept { return {ground_, index_.floor_geom, index_.foot_geom}; }

/// Each part has the friction of the place that it is over.
void Plant::feel_patches() noexcept {
  for (const int geom : index_.ground_geom) {
    const mjtNum* centre = row(data_->geom_xpos, geom, 3);
    set_friction(*model_, geom, ground_.friction(centre[0], centre[1], config_.contact.friction));
  }
}

/// After mj_kinematics.
void Plant::note_feet() noexcept {
  for (std::size_t leg = 0; leg < foot_m_.size(); ++leg) {
    foot_m_[leg] = vec3(row(data_->geom_xpos, index_.foot_geom[leg], 3));
    ground_.notice(leg, foot_m_[leg]);
  }
}

/// Parallel to the floor, rolled as the configuration says.
void Plant::turn_trunk() noexcept {
  mjtNum* attitude = data_->qpos + index_.free_qpos + 3;
  mju_quatZ2Vec(attitude, below_trunk().normal.data());
  if (config_.roll_rad == 0.0) return;
  mjtNum parallel[4];
  mju_copy4(parallel, attitude);
  const mjtNum rolled[4] = {std::cos(0.5 * config_.roll_rad), std::sin(0.5 * config_.roll_rad), 0.0, 0.0};
  mju_mulQuat(attitude, parallel, rolled);
}

/// The lowest point of the robot on the floor below it; a trunk that is free stands parallel to a slope.
void Plant::touch_floor() noexcept {
  if (index_.free_qpos >= 0 && config_.suspended_m <= 0.0) turn_trunk();
  mj_kinematics(model_.get(), data_.get());
  note_feet();
  place_floors();
  if (index_.height_qpos < 0) return;
  double lowest_m = mjMAXVAL;
  for (const int geom : index_.ground_geom) {
    const Vec3 centre_m = vec3(row(data_->geom_xpos, geom, 3));
    const auto foot = std::find(index_.foot_geom.begin(), index_.foot_geom.end(), geom);
    const auto leg = static_cast<std::size_t>(foot - index_.foot_geom.begin());
    const Ground::Place place = foot == index_.foot_geom.end() ? ground_.below(centre_m[0], centre_m[1])
                                                               : ground_.under(leg, centre_m[0], centre_m[1]);
    const double over_m = place.distance_m(centre_m) - row(model_->geom_size, geom, 3)[0];
    lowest_m = std::min(lowest_m, over_m / place.normal[2]);
  }
  data_->qpos[index_.height_qpos] -= lowest_m;
}

void Plant::step(const std::vector<double>& motor_torque_Nm) noexcept {
  if (failed()) return;
  if (varying_friction_) update_friction();
  std::copy(motor_torque_Nm.begin(), motor_torque_Nm.end(), motor_torque_Nm_.begin());
  apply_torques();
  push_feet();
  if (ground_.slippery_in_places()) feel_patches();
  const UnevenFloor floor = uneven_floor();
  if (index_.linkages.empty()) {
    mj_step(model_.get(), data_.get());
  } else {
    step_linked(model_.get(), data_.get(), index_.linkages);
  }
  if (ground_.uneven()) {
    note_feet();
    place_floors();
  }
  if (torsion_) step_rotors();
  if (presliding_) strain_friction();
  if (heating_) heat_gears();
  check();
}

/// A joint's motor acts on the joint itself, or through the gear's spring.
void Plant::apply_torques() noexcept {
  mju_zero(data_->qfrc_applied, model_->nv);
  for (std::size_t i = 0; i < gears_.size(); ++i) {
    Gear& gear = gears_[i];
    if (gear.torsion)
      gear.output_torque_Nm = gear.torsion->output_torque_Nm(position_rad(i), velocity_rad_s(i));
    data_->qfrc_applied[index_.joint_dof[i]] = gear.torsion ? gear.output_torque_Nm : motor_torque_Nm_[i];
    if (push_Nm_[i] != 0.0) data_->qfrc_applied[index_.joint_dof[i]] += push_Nm_[i];
  }
  for (const Linkage& linkage : index_.linkages) {
    Gear& gear = gears_[linkage.gear];
    gear.viscous_Nm = gear.viscous_Nm_s_rad * linkage.of_motor(data_->qvel);
    for (const Linkage::Part& part : linkage.parts)
      data_->qfrc_applied[part.dof] -= part.share * gear.viscous_Nm;
  }
  for (std::size_t i = 0; presliding_ && i < gears_.size(); ++i) hold_elastically(i);
}

/// A rotor of its own has it in step_rotors().
void Plant::hold_elastically(std::size_t gear) noexcept {
  Gear& held = gears_[gear];
  if (!held.presliding) return;
  held.elastic_Nm = held.presliding->torque_Nm(gear_speed_rad_s(gear));
  if (held.torsion) return;
  const Linkage* linkage = linkage_of(gear);
  if (linkage == nullptr) {
    data_->qfrc_applied[index_.joint_dof[gear]] -= held.elastic_Nm;
    return;
  }
  for (const Linkage::Part& part : linkage->parts)
    data_->qfrc_applied[part.dof] -= part.share * held.elastic_Nm;
}

/// By the way of the step that was just made: forces of its begin, then ways with its new speeds, so that
/// springs of friction and masses gain no energy.
void Plant::strain_friction() noexcept {
  for (std::size_t i = 0; i < gears_.size(); ++i) {
    if (gears_[i].presliding) gears_[i].presliding->move(gear_speed_rad_s(i) * step_s(), gears_[i].dry_Nm);
  }
}

void Plant::step_rotors() noexcept {
  for (std::size_t i = 0; i < gears_.size(); ++i) {
    Gear& gear = gears_[i];
    if (gear.torsion)
      gear.torsion->step(motor_torque_Nm_[i] - gear.elastic_Nm, gear.output_torque_Nm,
                         gear.presliding ? 0.0 : gear.dry_Nm, gear.viscous_Nm_s_rad, step_s());
  }
}

void Plant::heat_gears() noexcept {
  for (std::size_t i = 0; i < gears_.size(); ++i) {
    const double loss_W = friction_torque_Nm(i) * gear_speed_rad_s(i);
    if (gears_[i].friction.heats()) gears_[i].friction.heat(loss_W, step_s());
  }
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
  for (std::size_t i = 0; i < gears_.size(); ++i) {
    Gear& gear = gears_[i];
    const double dry_Nm = dry_friction_Nm(i);
    const double direction = dry_Nm > 0.0 ? 1.0 : (dry_Nm < 0.0 ? -1.0 : 0.0);
    gear.dry_Nm = gear.friction.dry_Nm(gear_speed_rad_s(i), gear_load_Nm(i), direction) *
                  gear.friction.ripple(gear.ratio * gear_angle_rad(i), position_rad(i));
    gear.viscous_Nm_s_rad = gear.friction.viscous_Nm_s_rad(direction);
    if (gear.torsion) continue;
    if (const Linkage* linkage = linkage_of(i)) {
      model_->tendon_frictionloss[linkage->tendon] = gear.presliding ? 0.0 : gear.dry_Nm;
      continue;
    }
    model_->dof_frictionloss[index_.joint_dof[i]] = gear.presliding ? 0.0 : gear.dry_Nm;
    model_->dof_damping[index_.joint_dof[i]] = gear.viscous_Nm_s_rad;
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
    foot_wrench_[leg] = wrench;
  }
}

void Plant::push_joint(int joint, double torque_Nm) noexcept {
  if (joint >= 0 && joint < static_cast<int>(push_Nm_.size())) push_Nm_[joint] = torque_Nm;
}

mjtNum* Plant::base_armature() const noexcept {
  return model_->dof_armature + std::max(0, model_->body_dofadr[index_.base_body]);  // -1 where it has none
}

void Plant::suspend(double height_m) noexcept {
  std::fill_n(base_armature(), base_armature_.size(), kLockedMass);
  std::fill_n(data_->qvel + (base_armature() - model_->dof_armature), base_armature_.size(), 0.0);
  mj_kinematics(model_.get(), data_.get());  // positions may be newer than poses
  if (height_m > 0.0 && index_.height_qpos >= 0)
    data_->qpos[index_.height_qpos] += height_m - row(data_->xpos, index_.base_body, 3)[2];
  const UnevenFloor floor = uneven_floor();
  mj_forward(model_.get(), data_.get());
}

void Plant::release() noexcept { std::copy(base_armature_.begin(), base_armature_.end(), base_armature()); }

}  // namespace sprung::sim
