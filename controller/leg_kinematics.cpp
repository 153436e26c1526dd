#include "controller/leg_kinematics.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "controller/one_link.h"
#include "controller/three_joint.h"
#include "controller/two_link.h"

namespace sprung {
namespace {

constexpr double kSingularBelow_m = 0.02;
constexpr double kDampingAtSingular_m = 0.02;

using JointMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxLegJoints, kMaxLegJoints>;

double smallest_eigenvalue(const JointMatrix& symmetric) noexcept {
  const Eigen::SelfAdjointEigenSolver<JointMatrix> solver(symmetric, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues()[0]);
}

}  // namespace

std::unique_ptr<LegKinematics> make_leg_kinematics(const LegConfig& leg) {
  if (leg.kinematics == kNoKinematics) return nullptr;
  if (leg.kinematics == kOneLink) return std::make_unique<OneLink>(leg);
  if (leg.kinematics == kTwoLink) return std::make_unique<TwoLink>(leg);
  if (leg.kinematics == kThreeJoint) return std::make_unique<ThreeJoint>(leg);
  throw std::invalid_argument("leg '" + leg.name + "': unknown kinematics '" + leg.kinematics +
                              "', there are: " + kOneLink + ", " + kTwoLink + ", " + kThreeJoint + ", " +
                              kNoKinematics);
}

DampedInverse damped_inverse(const LegJacobian& jacobian) noexcept {
  JointMatrix gram = jacobian.transpose() * jacobian;
  const double sigma_squared = smallest_eigenvalue(gram);
  DampedInverse out;
  out.singular = !(sigma_squared >= kSingularBelow_m * kSingularBelow_m);
  if (out.singular) {
    const double ratio_squared = sigma_squared / (kSingularBelow_m * kSingularBelow_m);
    gram.diagonal().array() += kDampingAtSingular_m * kDampingAtSingular_m * (1.0 - ratio_squared);
  }
  const JointMatrix inverse = gram.partialPivLu().inverse();
  out.matrix = jacobian * inverse;
  return out;
}

}  // namespace sprung
