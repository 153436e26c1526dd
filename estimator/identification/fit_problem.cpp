#include "estimator/identification/fit_problem.h"

#include <cmath>
#include <stdexcept>

namespace sprung::identification {

using Index = Eigen::Index;

namespace {

void check(const FitPiece& piece, const std::string& unit) {
  if (piece.weight.size() != piece.data.size() || piece.data.measured_torque.size() != piece.data.size())
    throw std::invalid_argument("a piece has " + std::to_string(piece.data.size()) + " samples, " +
                                std::to_string(piece.data.measured_torque.size()) + " torques and " +
                                std::to_string(piece.weight.size()) + " weights");
  if (!piece.weight.allFinite() || (piece.weight.array() < 0.0).any())
    throw std::invalid_argument("weights of samples must be finite and not negative");
  if (piece.data.torque_unit != unit)
    throw std::invalid_argument("pieces in '" + unit + "' and in '" + piece.data.torque_unit +
                                "' cannot be fitted together");
}

}  // namespace

FitProblem::FitProblem(const FitModel& model, const std::vector<FitPiece>& pieces)
    : model_(model), pieces_(pieces) {
  for (const FitPiece& piece : pieces) {
    check(piece, pieces.front().data.torque_unit);
    add(piece);
  }
  if (size() == 0) throw std::invalid_argument("no sample counts");
  stretches_.push_back(size());
}

void FitProblem::add(const FitPiece& piece) {
  std::vector<Index> counted;
  Index at = size();
  for (Index i = 0; i < piece.data.size(); ++i) {
    if (piece.weight[i] == 0.0) continue;
    if (counted.empty() || counted.back() != i - 1) stretches_.push_back(at);
    counted.push_back(i);
    ++at;
  }
  weight_.conservativeResize(at);
  measured_.conservativeResize(at);
  const Index from = at - static_cast<Index>(counted.size());
  for (std::size_t k = 0; k < counted.size(); ++k) {
    weight_[from + static_cast<Index>(k)] = piece.weight[counted[k]];
    measured_[from + static_cast<Index>(k)] = piece.data.measured_torque[counted[k]];
  }
  counted_.push_back(std::move(counted));
}

void FitProblem::evaluate(const Eigen::VectorXd& parameters, Eigen::VectorXd& residual,
                          Eigen::MatrixXd* jacobian) const {
  residual.resize(size());
  if (jacobian != nullptr) jacobian->resize(size(), parameters.size());
  Eigen::VectorXd prediction;
  Eigen::MatrixXd slopes;
  Index at = 0;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (counted_[p].empty()) continue;
    model_.predict(pieces_[p].data, parameters, prediction, jacobian != nullptr ? &slopes : nullptr);
    for (const Index i : counted_[p]) {
      residual[at] = prediction[i] - measured_[at];
      if (jacobian != nullptr) jacobian->row(at) = slopes.row(i);
      ++at;
    }
  }
}

}  // namespace sprung::identification
