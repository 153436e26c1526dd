#pragma once
/// Small models with known answers, and noise that is the same in every run.
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "estimator/identification/fit_model.h"

namespace sprung::identification {

/// SplitMix64's finaliser.
inline std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Normal noise of unit variance, from a hash of (seed, index): twelve uniform numbers.
inline double noise(std::uint64_t seed, Eigen::Index index) {
  double sum = -6.0;
  std::uint64_t state = mixed(mixed(seed + 0x9E3779B97F4A7C15u) + static_cast<std::uint64_t>(index));
  for (int i = 0; i < 12; ++i) {
    state += 0x9E3779B97F4A7C15u;
    sum += static_cast<double>(mixed(state) >> 11) * 0x1.0p-53;
  }
  return sum;
}

/// A joint that swings as sin(2 pi t / 7 s) plus a faster part, at 100 Hz. Torque is left at zero.
inline JointDataset swinging_joint(Eigen::Index samples) {
  JointDataset data;
  data.period_s = 0.01;
  data.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, 0.01 * static_cast<double>(samples - 1));
  const double slow = 2.0 * M_PI / 7.0, fast = 2.0 * M_PI / 1.7;
  const auto t = data.time_s.array();
  data.position_rad = 0.8 * (slow * t).sin() + 0.1 * (fast * t).sin();
  data.velocity_rad_s = 0.8 * slow * (slow * t).cos() + 0.1 * fast * (fast * t).cos();
  data.acceleration_rad_s2 = -0.8 * slow * slow * (slow * t).sin() - 0.1 * fast * fast * (fast * t).sin();
  data.measured_torque = Eigen::VectorXd::Zero(samples);
  return data;
}

inline FitPiece whole(const JointDataset& data) { return {data, Eigen::VectorXd::Ones(data.size())}; }

/// prediction = sum of parameter * column(data): any linear model.
class LinearModel : public FitModel {
 public:
  using Column = Eigen::VectorXd (*)(const JointDataset&);
  LinearModel(std::string name, std::vector<FitParameter> parameters, std::vector<Column> columns)
      : name_(std::move(name)), parameters_(std::move(parameters)), columns_(std::move(columns)) {}
  std::string name() const override { return name_; }
  const std::vector<FitParameter>& parameters() const override { return parameters_; }
  void predict(const JointDataset& data, const Eigen::VectorXd& parameters, Eigen::VectorXd& prediction,
               Eigen::MatrixXd* jacobian) const override {
    Eigen::MatrixXd columns(data.size(), parameters.size());
    for (Eigen::Index i = 0; i < parameters.size(); ++i) columns.col(i) = columns_[i](data);
    prediction = columns * parameters;
    if (jacobian != nullptr) *jacobian = columns;
  }

 private:
  std::string name_;
  std::vector<FitParameter> parameters_;
  std::vector<Column> columns_;
};

inline Eigen::VectorXd inertia_column(const JointDataset& data) { return data.acceleration_rad_s2; }
inline Eigen::VectorXd viscous_column(const JointDataset& data) { return data.velocity_rad_s; }
inline Eigen::VectorXd coulomb_column(const JointDataset& data) { return data.velocity_rad_s.cwiseSign(); }
inline Eigen::VectorXd offset_column(const JointDataset& data) { return Eigen::VectorXd::Ones(data.size()); }
inline Eigen::VectorXd sine_column(const JointDataset& data) { return data.position_rad.array().sin(); }

inline LinearModel inertia_and_friction() {
  return {"coulomb_viscous",
          {{"inertia", "kg m^2", 1.0, 0.0},
           {"coulomb", "Nm", 1.0, 0.0},
           {"viscous", "Nm s/rad", 1.0, 0.0},
           {"offset", "Nm"}},
          {inertia_column, coulomb_column, viscous_column, offset_column}};
}

/// The dataset with the torque that `model` says, and noise on it.
inline JointDataset simulated(const FitModel& model, const Eigen::VectorXd& truth, JointDataset data,
                              double noise_std, std::uint64_t seed) {
  model.predict(data, truth, data.measured_torque, nullptr);
  for (Eigen::Index i = 0; i < data.size(); ++i) data.measured_torque[i] += noise_std * noise(seed, i);
  return data;
}

}  // namespace sprung::identification
