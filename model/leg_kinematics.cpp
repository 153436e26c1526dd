#include "model/leg_kinematics.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "model/one_link.h"
#include "model/three_joint.h"
#include "model/two_link.h"

namespace sprung {
namespace {

constexpr double kSingularBelow_m = 0.02;
constexpr double kDampingAtSingular_m = 0.02;
constexpr double kSurely = 2.0;  ///< beyond what rounding can do to the bound below

using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxLegJoints,
                                  kMaxLegJoints>;

double smallest_eigenvalue(const JointMatrix& symmetric) noexcept {
  if (symmetric.rows() < 1)  // none; g++ 14 takes it that the solver would read what nobody has written
    return 0.0;
  const Eigen::SelfAdjointEigenSolver<JointMatrix> solver(symmetric, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues()[0]);
}

/// No eigenvalue of a symmetric positive definite matrix is less: the others' product is at most that of
/// their mean. Where it is well above what matters, nobody needs the eigenvalues themselves, which cost more
/// than all else here.
double eigenvalue_bound(double trace, double determinant, int size) noexcept {
  double bound = determinant;
  for (int others = 1; others < size; ++others) bound *= (size - 1) / trace;
  return bound;
}

/// Trace and determinant of J^T J.
bool surely_regular(double trace, double determinant, int size) noexcept {
  return eigenvalue_bound(trace, determinant, size) > kSurely * kSingularBelow_m * kSingularBelow_m;
}

/// For every J.
DampedInverse damped_inverse_of_gram(const LegJacobian& jacobian) noexcept {
  JointMatrix gram = jacobian.transpose() * jacobian;
  DampedInverse out;
  const Eigen::PartialPivLU<JointMatrix> factors(gram);
  if (surely_regular(gram.trace(), factors.determinant(), static_cast<int>(gram.rows()))) {
    out.matrix = jacobian * JointMatrix(factors.inverse());
    return out;
  }
  const double sigma_squared = smallest_eigenvalue(gram);
  out.singular = !(sigma_squared >= kSingularBelow_m * kSingularBelow_m);
  if (out.singular) {
    const double ratio_squared = sigma_squared / (kSingularBelow_m * kSingularBelow_m);
    gram.diagonal().array() += kDampingAtSingular_m * kDampingAtSingular_m * (1.0 - ratio_squared);
  }
  const JointMatrix inverse = gram.partialPivLu().inverse();
  out.matrix = jacobian * inverse;
  return out;
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

/// Three joints, away from singular poses: J is square and W its inverse, transposed; the general way costs
/// ten times as much.
DampedInverse damped_inverse(const LegJacobian& jacobian) noexcept {
  if (jacobian.cols() == 3) {
    const Eigen::Matrix3d square = jacobian;
    const double determinant = square.determinant();
    if (surely_regular(square.squaredNorm(), determinant * determinant, 3))
      return {square.inverse().transpose(), false};
  }
  return damped_inverse_of_gram(jacobian);
}

}  // namespace sprung
