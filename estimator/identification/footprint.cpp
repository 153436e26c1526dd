#include "estimator/identification/footprint.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sprung::identification {

TorsionSpring::TorsionSpring(std::vector<TorsionStage> stages) : stages_(std::move(stages)) {
  if (stages_.empty() || stages_.front().from_Nm != 0.0)
    throw std::invalid_argument("the first stage of a torsion spring begins at 0 Nm");
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (!(stages_[i].stiffness_Nm_rad > 0.0))
      throw std::invalid_argument("stage " + std::to_string(i) +
                                  " of a torsion spring needs a positive stiffness");
    if (i > 0 && !(stages_[i].from_Nm > stages_[i - 1].from_Nm))
      throw std::invalid_argument("stage " + std::to_string(i) +
                                  " of a torsion spring begins before the one below");
    from_rad_.push_back(i == 0 ? 0.0
                               : from_rad_[i - 1] + (stages_[i].from_Nm - stages_[i - 1].from_Nm) /
                                                        stages_[i - 1].stiffness_Nm_rad);
  }
}

double TorsionSpring::angle_rad(double torque_Nm) const noexcept {
  const double size_Nm = std::abs(torque_Nm);
  std::size_t i = stages_.size() - 1;
  while (i > 0 && size_Nm < stages_[i].from_Nm) --i;
  return std::copysign(from_rad_[i] + (size_Nm - stages_[i].from_Nm) / stages_[i].stiffness_Nm_rad,
                       torque_Nm);
}

double TorsionSpring::torque_Nm(double angle_rad) const noexcept {
  const double size_rad = std::abs(angle_rad);
  std::size_t i = stages_.size() - 1;
  while (i > 0 && size_rad < from_rad_[i]) --i;
  return std::copysign(stages_[i].from_Nm + (size_rad - from_rad_[i]) * stages_[i].stiffness_Nm_rad,
                       angle_rad);
}

namespace {

using Index = Eigen::Index;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// Compliances of gears from the size of a finger to that of a waist: 1e3 to 1e6 Nm/rad.
constexpr double kLeastCompliance_rad_Nm = 1e-7;
constexpr double kUsualCompliance_rad_Nm = 3e-5;  ///< facts papers D7: 2.5 to 3.4e4 Nm/rad

void write_harmonics(const Eigen::ArrayXd& angle, const std::vector<int>& harmonics, Index& at,
                     Eigen::MatrixXd& columns) {
  for (const int harmonic : harmonics) {
    columns.col(at++) = (harmonic * angle).cos();
    columns.col(at++) = (harmonic * angle).sin();
  }
}

}  // namespace

JointDataset encoder_difference(const JointDataset& data) {
  if (!data.has_link_position()) throw std::invalid_argument("a footprint needs the link's encoder");
  if (!data.has_load())
    throw std::invalid_argument(
        "a footprint needs the load: torsion cannot be told from kinematic error without it");
  JointDataset out = data;
  out.measured_torque = data.position_rad - data.link_position_rad;
  out.torque_unit = "rad";
  return out;
}

FootprintModel::FootprintModel(FootprintTerms terms) : terms_(std::move(terms)) {
  parameters_.push_back({"offset", "rad", 0.0, -kUnbounded, kUnbounded, {}, "any motion"});
  add_harmonics("motor", terms_.motor_harmonics);
  add_harmonics("link", terms_.link_harmonics);
  if (!terms_.spring)
    parameters_.push_back({"compliance",
                           "rad/Nm",
                           kUsualCompliance_rad_Nm,
                           kLeastCompliance_rad_Nm,
                           kUnbounded,
                           {},
                           "different loads at the same position"});
}

void FootprintModel::add_harmonics(const char* side, const std::vector<int>& harmonics) {
  for (const int harmonic : harmonics) {
    for (const char* part : {"_cos", "_sin"})
      parameters_.push_back({std::string(side) + "_" + std::to_string(harmonic) + part,
                             "rad",
                             0.0,
                             -kUnbounded,
                             kUnbounded,
                             {},
                             "a whole turn of the link"});
  }
}

std::string FootprintModel::name() const {
  return terms_.motor_harmonics.empty() && terms_.link_harmonics.empty() ? "torsion" : "footprint";
}

Eigen::MatrixXd FootprintModel::columns(const JointDataset& data) const {
  const Index count = static_cast<Index>(parameters_.size()) - (terms_.spring ? 0 : 1);
  Eigen::MatrixXd out(data.size(), count);
  out.col(0).setOnes();
  Index at = 1;
  write_harmonics(data.gear_ratio * data.position_rad.array(), terms_.motor_harmonics, at, out);
  write_harmonics(data.link_position_rad.array(), terms_.link_harmonics, at, out);
  return out;
}

void FootprintModel::predict(const JointDataset& data, const Eigen::VectorXd& parameters,
                             Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const {
  const Eigen::MatrixXd linear = columns(data);
  prediction = linear * parameters.head(linear.cols());
  if (terms_.spring) {
    prediction += data.load_Nm.unaryExpr(
        [this](double load_Nm) { return terms_.spring->angle_rad(load_Nm); });
  } else {
    prediction += parameters[linear.cols()] * data.load_Nm;
  }
  if (jacobian == nullptr) return;
  jacobian->resize(data.size(), parameters.size());
  jacobian->leftCols(linear.cols()) = linear;
  if (!terms_.spring) jacobian->col(linear.cols()) = data.load_Nm;
}

Eigen::VectorXd FootprintModel::torque_Nm(const JointDataset& data, const Eigen::VectorXd& parameters) const {
  const Eigen::MatrixXd linear = columns(data);
  const Eigen::VectorXd torsion_rad = data.position_rad - data.link_position_rad -
                                      linear * parameters.head(linear.cols());
  if (!terms_.spring) return torsion_rad / parameters[linear.cols()];
  return torsion_rad.unaryExpr([this](double angle_rad) { return terms_.spring->torque_Nm(angle_rad); });
}

double FootprintModel::stiffness_Nm_rad(const Eigen::VectorXd& parameters) const {
  if (!terms_.spring) return 1.0 / parameters[parameters.size() - 1];
  constexpr double kSmall_Nm = 1e-3;
  return kSmall_Nm / terms_.spring->angle_rad(kSmall_Nm);
}

}  // namespace sprung::identification
