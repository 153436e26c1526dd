#pragma once
/// Legs as chains of rotations, link by link, with energies: knows nothing of the equations in controller/.
/// Torque for a motion comes from Lagrange's equation by numeric differentiation.
#include <Eigen/Geometry>
#include <vector>

#include "model/leg_kinematics.h"

namespace sprung::test {

struct ReferenceLink {
  Eigen::Vector3d axis;   ///< of its joint
  Eigen::Vector3d along;  ///< unit vector in which length and com are measured, at zero
  LinkConfig link;
  Eigen::Matrix3d inertia_kg_m2;  ///< about the centre of mass, at zero
};

class ReferenceChain {
 public:
  explicit ReferenceChain(const LegConfig& leg) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                          z = Eigen::Vector3d::UnitZ();
    if (leg.kinematics == kOneLink) {
      add(-y, -z, leg.links[0], across(-z, leg.links[0]));
      return;
    }
    std::size_t next = 0;
    if (leg.kinematics == kThreeJoint) {
      const LinkConfig& hip = leg.links[next++];
      add(x, leg.side == LegSide::kLeft ? y : Eigen::Vector3d(-y), hip,
          hip.inertia_kg_m2 * x * x.transpose());
    }
    add(y, x, leg.links[next], across(x, leg.links[next]));
    add(-y, x, leg.links[next + 1], across(x, leg.links[next + 1]));
  }

  int joint_count() const { return static_cast<int>(links_.size()); }

  Eigen::Vector3d foot_m(const JointVector& q) const {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    for (int i = 0; i < joint_count(); ++i) {
      turned = turned * turn(i, q);
      at += turned * (link(i).along * link(i).link.length_m);
    }
    return at;
  }

  double potential_energy_J(const JointVector& q) const {
    double energy = 0.0;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    for (int i = 0; i < joint_count(); ++i) {
      turned = turned * turn(i, q);
      const Eigen::Vector3d along = turned * link(i).along;
      energy += link(i).link.mass_kg * 9.81 * (at + along * link(i).link.com_m).z();
      at += along * link(i).link.length_m;
    }
    return energy;
  }

  double kinetic_energy_J(const JointVector& q, const JointVector& w) const {
    double energy = 0.0;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    for (int i = 0; i < joint_count(); ++i) {
      turned = turned * turn(i, q);
      rate += turned * link(i).axis * w[i];
      const Eigen::Vector3d along = turned * link(i).along;
      const Eigen::Vector3d of_com = velocity + rate.cross(along * link(i).link.com_m);
      energy += 0.5 * link(i).link.mass_kg * of_com.squaredNorm();
      energy += 0.5 * rate.dot(turned * link(i).inertia_kg_m2 * turned.transpose() * rate);
      velocity += rate.cross(along * link(i).link.length_m);
    }
    return energy;
  }

  JointVector gravity_torque_Nm(const JointVector& q) const {
    return gradient(q, [&](const JointVector& at) { return potential_energy_J(at); });
  }

  /// d/dt dT/dw - dT/dq + dV/dq.
  JointVector torque_Nm(const JointVector& q, const JointVector& w, const JointVector& a) const {
    constexpr double kStep_s = 1e-5;
    const auto momentum = [&](double t) { return momentum_at(q + t * w + 0.5 * t * t * a, w + t * a); };
    const JointVector rise = (momentum(kStep_s) - momentum(-kStep_s)) / (2.0 * kStep_s);
    return rise - gradient(q, [&](const JointVector& at) { return kinetic_energy_J(at, w); }) +
           gravity_torque_Nm(q);
  }

 private:
  /// Of a thin rod along this.
  static Eigen::Matrix3d across(const Eigen::Vector3d& along, const LinkConfig& link) {
    return link.inertia_kg_m2 * (Eigen::Matrix3d::Identity() - along * along.transpose());
  }
  void add(const Eigen::Vector3d& axis, const Eigen::Vector3d& along, const LinkConfig& link,
           const Eigen::Matrix3d& inertia) {
    links_.push_back({axis, along, link, inertia});
  }
  const ReferenceLink& link(int i) const { return links_[i]; }
  Eigen::Matrix3d turn(int i, const JointVector& q) const {
    return Eigen::AngleAxisd(q[i], link(i).axis).toRotationMatrix();
  }
  template <class Energy>
  static JointVector gradient(const JointVector& q, const Energy& energy) {
    constexpr double kStep_rad = 1e-5;
    JointVector slope(q.size());
    for (int i = 0; i < q.size(); ++i) {
      JointVector ahead = q, behind = q;
      ahead[i] += kStep_rad;
      behind[i] -= kStep_rad;
      slope[i] = (energy(ahead) - energy(behind)) / (2.0 * kStep_rad);
    }
    return slope;
  }
  /// The energy is quadratic in velocity, so that a difference over any step is exact.
  JointVector momentum_at(const JointVector& q, const JointVector& w) const {
    JointVector momentum(q.size());
    for (int i = 0; i < q.size(); ++i) {
      JointVector ahead = w, behind = w;
      ahead[i] += 1.0;
      behind[i] -= 1.0;
      momentum[i] = 0.5 * (kinetic_energy_J(q, ahead) - kinetic_energy_J(q, behind));
    }
    return momentum;
  }

  std::vector<ReferenceLink> links_;
};

}  // namespace sprung::test
