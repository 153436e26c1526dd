#include "simulation/plant/linkage.h"

#include <Eigen/Dense>
#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/mujoco_row.h"

namespace sprung::sim {
namespace {

constexpr double kNoShare = 1e-12;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Row of the inverse transmission: motor speeds from joint speeds.
RowMajor motor_from_joints(const LegConfig& leg) {
  const auto size = static_cast<Eigen::Index>(leg.joints.size());
  if (leg.actuators.size() != leg.joints.size() ||
      leg.transmission.size() != leg.joints.size() * leg.joints.size())
    throw ConfigError(leg.name + ": transmission is not square");
  return Eigen::Map<const RowMajor>(leg.transmission.data(), size, size).inverse();
}

Linkage make_linkage(const LegConfig& leg, const RowMajor& shares, Eigen::Index motor,
                     const std::vector<int>& joint_dof) {
  Linkage linkage;
  linkage.gear = static_cast<std::size_t>(leg.joints[static_cast<std::size_t>(motor)]);
  const auto add = [&](Eigen::Index column) {
    const auto joint = static_cast<std::size_t>(leg.joints[static_cast<std::size_t>(column)]);
    if (std::abs(shares(motor, column)) > kNoShare)
      linkage.parts.push_back({joint, joint_dof[joint], shares(motor, column)});
  };
  add(motor);
  for (Eigen::Index column = 0; column < shares.cols(); ++column) {
    if (column != motor) add(column);
  }
  return linkage;
}

void write_tendon(mjModel& model, Linkage& linkage, const std::string& joint, double step_s) {
  linkage.tendon = mj_name2id(&model, mjOBJ_TENDON, (joint + "_linkage").c_str());
  if (linkage.tendon < 0) throw ConfigError("model.xml: no tendon '" + joint + "_linkage'");
  const int first = model.tendon_adr[linkage.tendon];
  std::size_t found = 0;
  for (int wrap = first; wrap < first + model.tendon_num[linkage.tendon]; ++wrap) {
    for (const Linkage::Part& part : linkage.parts) {
      if (model.jnt_dofadr[model.wrap_objid[wrap]] != part.dof) continue;
      model.wrap_prm[wrap] = part.share;
      ++found;
    }
  }
  if (found != linkage.parts.size() || static_cast<int>(found) != model.tendon_num[linkage.tendon])
    throw ConfigError("model.xml: tendon '" + joint +
                      "_linkage' has other joints than robot.yaml's transmission");
  row(model.tendon_solref_fri, linkage.tendon, mjNREF)[0] = -1.0;  // sticks: facts physics 1
  row(model.tendon_solref_fri, linkage.tendon, mjNREF)[1] = -1.0 / step_s;
}

/// From the joint, where it was written, to the motor.
void move_gear(mjModel& model, Linkage& linkage) {
  const int own = linkage.own().dof;
  linkage.armature_kg_m2 = model.dof_armature[own];
  model.dof_armature[own] = 0.0;
  model.tendon_frictionloss[linkage.tendon] = model.dof_frictionloss[own];
  for (int i = 0; i < mjNIMP; ++i)
    row(model.tendon_solimp_fri, linkage.tendon, mjNIMP)[i] = row(model.dof_solimp, own, mjNIMP)[i];
  model.dof_frictionloss[own] = 0.0;
  model.dof_damping[own] = 0.0;
}

/// Where qM has the entry of two degrees of freedom of one chain.
int inertia_address(const mjModel& model, int outer, int inner) noexcept {
  int address = model.dof_Madr[outer];
  for (int dof = outer; dof != inner; dof = model.dof_parentid[dof]) ++address;
  return address;
}

}  // namespace

double Linkage::of_motor(const mjtNum* values) const noexcept {
  double sum = 0.0;
  for (const Part& part : parts) sum += part.share * values[part.dof];
  return sum;
}

std::vector<Linkage> link_rotors(mjModel& model, const std::vector<int>& joint_dof, const RobotConfig& robot,
                                 const PlantConfig& config) {
  std::vector<Linkage> linkages;
  for (const LegConfig& leg : robot.legs) {
    const RowMajor shares = motor_from_joints(leg);
    for (Eigen::Index motor = 0; motor < shares.rows(); ++motor) {
      Linkage linkage = make_linkage(leg, shares, motor, joint_dof);
      if (linkage.parts.size() < 2) continue;
      const PlantJointConfig& joint = config.joints[linkage.gear];
      if (config.torsion && joint.torsion)
        throw ConfigError(joint.name + ": a gear behind a linkage cannot have torsion");
      write_tendon(model, linkage, joint.name, config.step_s);
      move_gear(model, linkage);
      linkages.push_back(linkage);
    }
  }
  for (const Linkage& linkage : linkages) {  // afterwards: a joint may carry its own rotor and another's
    for (const Linkage::Part& part : linkage.parts)
      model.dof_armature[part.dof] += linkage.armature_kg_m2 * part.share * part.share;
  }
  return linkages;
}

void step_linked(const mjModel* model, mjData* data, const std::vector<Linkage>& linkages) noexcept {
  mj_checkPos(model, data);
  mj_checkVel(model, data);
  mj_fwdPosition(model, data);
  for (const Linkage& linkage : linkages) {
    for (const Linkage::Part& a : linkage.parts) {
      for (const Linkage::Part& b : linkage.parts) {
        if (a.dof > b.dof)
          data->qM[inertia_address(*model, a.dof, b.dof)] += linkage.armature_kg_m2 * a.share * b.share;
      }
    }
  }
  mj_factorM(model, data);
  mj_fwdVelocity(model, data);
  mj_fwdActuation(model, data);
  mj_fwdAcceleration(model, data);
  mj_fwdConstraint(model, data);
  mj_checkAcc(model, data);
  mj_Euler(model, data);
}

}  // namespace sprung::sim
