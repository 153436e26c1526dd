#pragma once
/// A model and the pieces of data that it is fitted to or scored on, as one vector of residuals. Pure.
#include <Eigen/Core>
#include <vector>

#include "estimator/identification/dataset.h"
#include "estimator/identification/fit_model.h"

namespace sprung::identification {

class FitProblem {
 public:
  /// Keeps references: model and pieces must outlive it.
  /// @throws std::invalid_argument when a piece's weights do not fit its data, are negative or not finite,
  /// units differ between pieces, or no sample counts.
  FitProblem(const FitModel& model, const std::vector<FitPiece>& pieces);

  const FitModel& model() const { return model_; }
  Eigen::Index size() const { return weight_.size(); }
  /// Of the samples that count (weight > 0), pieces one after another.
  const Eigen::VectorXd& weight() const { return weight_; }
  const Eigen::VectorXd& measured() const { return measured_; }
  /// Where stretches of samples begin that follow each other without a gap; the last entry is size().
  const std::vector<Eigen::Index>& stretches() const { return stretches_; }

  /// residual = prediction - measured. @param jacobian may be null.
  void evaluate(const Eigen::VectorXd& parameters, Eigen::VectorXd& residual,
                Eigen::MatrixXd* jacobian) const;

 private:
  void add(const FitPiece& piece);

  const FitModel& model_;
  const std::vector<FitPiece>& pieces_;
  std::vector<std::vector<Eigen::Index>> counted_;  ///< samples of each piece
  std::vector<Eigen::Index> stretches_;
  Eigen::VectorXd weight_;
  Eigen::VectorXd measured_;
};

}  // namespace sprung::identification
