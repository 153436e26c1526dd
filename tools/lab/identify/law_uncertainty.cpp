#include "tools/lab/identify/law_uncertainty.h"

#include <algorithm>
#include <cmath>

namespace sprung::identify {

using identification::FitPiece;
using identification::ModelResult;

namespace {

constexpr double kMost = 10.0;
/// [design choice] Of a gear of 4 kg of steel, 2 kJ/K, whose housing warms by half a kelvin for each watt, as
/// test_axis has it; one thermal state (docs/sources.md, facts D2). What it is wrong by, the friction that is
/// seen corrects.
constexpr double kResistance_K_W = 0.5, kTimeConstant_s = 1000.0;
/// Of a thermometer in the room, and of a gear that has rested in it.
constexpr double kThermometer_K = 1.5;

struct LawColumns {
  std::vector<Eigen::Index> at;  ///< of the model's parameters
  Eigen::MatrixXd covariance;
};

bool is_of_the_law(const std::string& parameter) {
  const auto& table = friction_parameter_table();
  return std::any_of(table.begin(), table.end(),
                     [&](const FrictionParameterInfo& row) { return parameter == row.name; });
}

LawColumns law_columns(const ModelResult& model) {
  LawColumns out;
  const auto& parameters = model.model->parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (is_of_the_law(parameters[i].name)) out.at.push_back(static_cast<Eigen::Index>(i));
  }
  const auto count = static_cast<Eigen::Index>(out.at.size());
  Eigen::VectorXd std_of(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double error = model.statistics.standard_error[out.at[static_cast<std::size_t>(k)]];
    const double value = model.fit.parameters[out.at[static_cast<std::size_t>(k)]];
    std_of[k] = std::isfinite(error) ? error : std::abs(value);
  }
  out.covariance.resize(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index m = 0; m < count; ++m)
      out.covariance(k, m) = std_of[k] * std_of[m] *
                             model.statistics.correlation(out.at[static_cast<std::size_t>(k)],
                                                          out.at[static_cast<std::size_t>(m)]);
  }
  return out;
}

}  // namespace

double fitted_law_share(const ModelResult& model, const std::vector<FitPiece>& recorded) {
  const LawColumns law = law_columns(model);
  const FrictionParameters friction = model.model->friction(model.fit.parameters);
  double law_Nm2 = 0.0, spread_Nm2 = 0.0;
  for (const FitPiece& piece : recorded) {
    Eigen::VectorXd torque_Nm;
    Eigen::MatrixXd jacobian;
    model.model->predict(piece.data, model.fit.parameters, torque_Nm, &jacobian);
    const Eigen::VectorXd output_Nm = model.model->gear_output(piece.data, model.fit.parameters);
    for (Eigen::Index i = 0; i < piece.data.size(); ++i) {
      if (!(piece.weight[i] > 0.0)) continue;
      Eigen::VectorXd gradient(law.covariance.rows());
      for (Eigen::Index k = 0; k < gradient.size(); ++k)
        gradient[k] = jacobian(i, law.at[static_cast<std::size_t>(k)]);
      FrictionInput at;
      at.velocity_rad_s = piece.data.velocity_rad_s[i];
      at.gear_output_torque_Nm = output_Nm[i];
      const double friction_Nm = friction_torque_Nm(friction, at);
      law_Nm2 += friction_Nm * friction_Nm;
      spread_Nm2 += gradient.dot(law.covariance * gradient);
    }
  }
  return law_Nm2 > 0.0 ? std::sqrt(std::max(0.0, spread_Nm2) / law_Nm2) : kMost;
}

ThermalParameters thermal_in_room(const ThermalParameters& known, double ambient_C) {
  ThermalParameters out = known;
  if (!(out.time_constant_s > 0.0)) {
    out.resistance_K_W = kResistance_K_W;
    out.time_constant_s = kTimeConstant_s;
  }
  out.ambient_C = ambient_C;
  out.ambient_std_K = kThermometer_K;
  return out;
}

double law_uncertainty(const ModelResult& model, const std::vector<FitPiece>& recorded, double day_to_day) {
  const double fitted = fitted_law_share(model, recorded);
  return std::min(kMost, std::sqrt(day_to_day * day_to_day + fitted * fitted));
}

}  // namespace sprung::identify
