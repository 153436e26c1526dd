#include "tools/lab/friction/friction_sweep_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

using namespace identification;
using Eigen::Index;
using Eigen::VectorXd;

VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

bool sensed(const SweepRecording& recording) {
  return recording.protocol == SweepProtocol::kLoaded && !recording.passes.front().sensed_torque_Nm.empty();
}

/// The gear holds against what the outside world does; the sensor sees the link's weight too.
VectorXd load_of(const SweepRecording& recording, const RecordedPass& pass) {
  const auto count = static_cast<Index>(pass.time_s.size());
  return sensed(recording) ? vector_of(pass.sensed_torque_Nm) : VectorXd::Constant(count, -pass.pass.load_Nm);
}

FitPiece piece_of(const SweepRecording& recording, const RecordedPass& pass) {
  FitPiece out;
  const auto count = static_cast<Index>(pass.time_s.size());
  out.data.gear_ratio = recording.gear_ratio;
  out.data.time_s = vector_of(pass.time_s);
  out.data.period_s = count > 1 ? pass.time_s[1] - pass.time_s[0] : 1.0;
  out.data.position_rad = vector_of(pass.position_rad);
  out.data.velocity_rad_s = VectorXd::Constant(count, pass.velocity_rad_s);
  out.data.acceleration_rad_s2 = VectorXd::Zero(count);
  out.data.measured_torque = vector_of(pass.motor_torque_Nm);
  out.data.load_Nm = load_of(recording, pass);
  out.weight = VectorXd::Ones(count);
  return out;
}

FitPiece mean_of(const FitPiece& piece) {
  FitPiece out = piece;
  for (VectorXd* v :
       {&out.data.time_s, &out.data.position_rad, &out.data.velocity_rad_s, &out.data.acceleration_rad_s2,
        &out.data.measured_torque, &out.data.load_Nm, &out.weight})
    *v = VectorXd::Constant(1, v->mean());
  return out;
}

/// There and back at the same speed over the same angles: weight and outside load drop out.
FitPiece magnitude_of(const FitPiece& there, const FitPiece& back) {
  FitPiece out = mean_of(there);
  const FitPiece other = mean_of(back);
  out.data.velocity_rad_s = 0.5 * (out.data.velocity_rad_s - other.data.velocity_rad_s);
  out.data.measured_torque = 0.5 * (out.data.measured_torque - other.data.measured_torque);
  out.data.load_Nm.setZero();
  return out;
}

/// Of the passes (or pairs) that are held out, or of the others.
std::vector<FitPiece> part(const SweepRecording& recording, SweepPoints points, bool held_out) {
  std::vector<FitPiece> out;
  const std::vector<FitPiece> all = sweep_pieces(recording, points);
  const std::size_t stride = points == SweepPoints::kBoth ? 1 : 2;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (recording.passes[i * stride].pass.held_out == held_out) out.push_back(all[i]);
  }
  return out;
}

bool has_own_weight(const SweepRecording& recording, SweepPoints points) {
  return (points == SweepPoints::kForward || points == SweepPoints::kBoth) && !sensed(recording);
}

/// A straight line through each piece's mean |friction| over |speed|.
SweepStart start_of(const std::vector<FitPiece>& pieces) {
  SweepStart out;
  const auto n = static_cast<Index>(pieces.size());
  Eigen::MatrixXd line(n, 2);
  VectorXd friction_Nm(n);
  for (Index i = 0; i < n; ++i) {
    const JointDataset& data = pieces[i].data;
    line.row(i) << 1.0, std::abs(data.velocity_rad_s[0]);
    friction_Nm[i] = std::copysign(1.0, data.velocity_rad_s[0]) *
                     (data.measured_torque - data.load_Nm).mean();
  }
  const Eigen::Vector2d found = line.colPivHouseholderQr().solve(friction_Nm);
  out.slowest_rad_s = line.col(1).minCoeff();
  out.fastest_rad_s = line.col(1).maxCoeff();
  out.coulomb_Nm = std::max(found[0], 0.1 * friction_Nm.cwiseAbs().mean());
  out.viscous_Nm_s_rad = std::max(found[1], 0.01 * out.coulomb_Nm / out.fastest_rad_s);
  return out;
}

FitOptions plain() {
  FitOptions out;
  out.loss = RobustLoss::kNone;
  return out;
}

std::vector<FrictionPoint> friction_points(const SweepModel& model, const VectorXd& parameters,
                                           const std::vector<FitPiece>& pieces) {
  std::vector<FrictionPoint> out;
  for (const FitPiece& piece : pieces) {
    VectorXd prediction;
    model.predict(piece.data, parameters, prediction, nullptr);
    const VectorXd load_Nm = model.load_Nm(piece.data, parameters);
    for (Index i = 0; i < piece.data.size(); ++i)
      out.push_back({piece.data.velocity_rad_s[i], load_Nm[i], piece.data.measured_torque[i] - load_Nm[i],
                     prediction[i] - load_Nm[i]});
  }
  return out;
}

FitScore score_of(const std::vector<FrictionPoint>& points) {
  VectorXd measured(static_cast<Index>(points.size())), residual(measured.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    measured[static_cast<Index>(i)] = points[i].measured_Nm;
    residual[static_cast<Index>(i)] = points[i].fitted_Nm - points[i].measured_Nm;
  }
  return points.empty() ? FitScore{} : score(measured, residual);
}

/// Means of whole passes have one position, which cannot tell the weight from friction: it comes from the
/// single samples.
void weigh(const SweepRecording& recording, const JointTerms& terms, std::vector<FitPiece>& pieces) {
  const SweepFit single = fit_sweep(recording, SweepPoints::kBoth, terms);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const FitPiece pass = piece_of(recording, recording.passes[2 * i]);
    pieces[i].data.load_Nm.setConstant(single.model->load_Nm(pass.data, single.fit.parameters).mean());
  }
}

FitScore held_out_score(const SweepRecording& recording, SweepPoints points, const SweepModel& model) {
  const std::vector<FitPiece> train = part(recording, points, false);
  const std::vector<FitPiece> test = part(recording, points, true);
  if (points != SweepPoints::kBoth || train.empty() || test.empty()) return {};
  const Fit found = fit(FitProblem(model, train), plain());
  return score_of(friction_points(model, found.parameters, test));
}

}  // namespace

std::vector<FitPiece> sweep_pieces(const SweepRecording& recording, SweepPoints points) {
  std::vector<FitPiece> out;
  const std::vector<RecordedPass>& passes = recording.passes;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const FitPiece piece = piece_of(recording, passes[i]);
    if (points == SweepPoints::kBoth) {
      out.push_back(piece);
    } else if (i % 2 == 0) {
      out.push_back(points == SweepPoints::kForward ? piece
                    : points == SweepPoints::kForwardMeans
                        ? mean_of(piece)
                        : magnitude_of(piece, piece_of(recording, passes[i + 1])));
    }
  }
  return out;
}

std::vector<JointTerms> sweep_models(const SweepRecording& recording, SweepPoints points) {
  using T = JointTerm;
  std::vector<JointTerms> out = {{}, {T::kViscous}, {T::kViscous, T::kStribeck}};
  if (points != SweepPoints::kBoth) return out;
  out.push_back({T::kViscous, T::kStribeck, T::kAsymmetry});
  if (recording.protocol != SweepProtocol::kLoaded) return out;
  out.push_back({T::kViscous, T::kStribeck, T::kLoad});
  out.push_back({T::kViscous, T::kStribeck, T::kLoad, T::kAsymmetry});
  return out;
}

SweepFit fit_sweep(const SweepRecording& recording, SweepPoints points, const JointTerms& terms) {
  if (recording.passes.size() < 2) throw std::invalid_argument("the sweep has no passes");
  std::vector<FitPiece> pieces = sweep_pieces(recording, points);
  if (points == SweepPoints::kForwardMeans && !sensed(recording)) weigh(recording, terms, pieces);
  SweepFit out;
  out.model = std::make_shared<SweepModel>(terms, has_own_weight(recording, points), start_of(pieces));
  const FitProblem problem(*out.model, pieces);
  out.fit = fit(problem, plain());
  out.statistics = statistics(problem, out.fit);
  out.points = friction_points(*out.model, out.fit.parameters, pieces);
  out.score = score_of(out.points);
  out.held_out = held_out_score(recording, points, *out.model);
  return out;
}

Estimate parameter(const SweepFit& fit, const std::string& name) {
  const std::vector<FitParameter>& all = fit.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto k = static_cast<Index>(i);
    if (all[i].name == name) return {fit.fit.parameters[k], fit.statistics.standard_error[k]};
  }
  return {};
}

}  // namespace sprung
