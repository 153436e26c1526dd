#include "estimator/identification/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "estimator/identification/fit_statistics.h"
#include "signals/quantile.h"

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr Index kFewestInBlock = 20;

/// The training pieces with one block's samples counting, or all others'.
struct Fold {
  std::vector<FitPiece> fitted;
  std::vector<FitPiece> left_out;
};

Index counted(const std::vector<FitPiece>& pieces) {
  Index out = 0;
  for (const FitPiece& piece : pieces) out += (piece.weight.array() > 0.0).count();
  return out;
}

Fold fold(const std::vector<FitPiece>& training, Index from, Index to) {
  Fold out{training, training};
  Index at = 0;
  for (std::size_t p = 0; p < training.size(); ++p) {
    for (Index i = 0; i < training[p].weight.size(); ++i) {
      if (training[p].weight[i] == 0.0) continue;
      const bool inside = at >= from && at < to;
      (inside ? out.fitted : out.left_out)[p].weight[i] = 0.0;
      ++at;
    }
  }
  return out;
}

Eigen::VectorXd left_out_residual(const FitModel& model, const Fold& fold, const Eigen::VectorXd& start,
                                  const FitOptions& options) {
  const Fit found = fit_from(FitProblem(model, fold.fitted), start, options);
  Eigen::VectorXd residual;
  FitProblem(model, fold.left_out).evaluate(found.parameters, residual, nullptr);
  return residual;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Standard error of the mean.
double mean_error(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  const double n = static_cast<double>(values.size());
  return std::sqrt(sum / (n - 1.0) / n);
}

double variance_of(const FitModel& model, const std::vector<FitPiece>& training) {
  const Eigen::VectorXd measured = FitProblem(model, training).measured();
  return (measured.array() - measured.mean()).square().mean();
}

bool acts(const FitParameter& parameter, double value) {
  const bool low = value - parameter.lower < parameter.upper - value;
  return (low ? parameter.lower : parameter.upper) != 0.0;
}

bool out_of_bounds(const FitModel& model, const Fit& found) {
  for (std::size_t i = 0; i < found.at_bound.size(); ++i) {
    const double value = found.parameters[static_cast<Index>(i)];
    const FitParameter& parameter = model.parameters()[i];
    if (found.at_bound[i] && parameter.lower != parameter.upper && acts(parameter, value)) return true;
  }
  return false;
}

}  // namespace

double CrossValidation::r2() const { return 1.0 - mean(mean_square); }

Difference difference(const CrossValidation& a, const CrossValidation& b) {
  std::vector<double> blocks = a.mean_square;
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] -= b.mean_square[i];
  return {mean(blocks), mean_error(blocks)};
}

int free_parameters(const FitModel& model) {
  const auto& all = model.parameters();
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const FitParameter& p) { return p.lower != p.upper; }));
}

CrossValidation cross_validate(const FitModel& model, const std::vector<FitPiece>& training,
                               const CrossValidationOptions& options) {
  const Index samples = counted(training);
  const Index blocks = options.blocks;
  if (blocks < 2 || samples < blocks * kFewestInBlock)
    throw std::invalid_argument(std::to_string(samples) + " samples are too few to choose a model in " +
                                std::to_string(blocks) + " blocks; record longer");
  const double variance = variance_of(model, training);
  // The whole training part settles which valley; the blocks' fits begin there.
  const Fit whole = fit(FitProblem(model, training), options.fit);
  CrossValidation out;
  out.out_of_bounds = out_of_bounds(model, whole);
  std::vector<double> sizes;
  for (Index b = 0; b < blocks; ++b) {
    const Fold one = fold(training, samples * b / blocks, samples * (b + 1) / blocks);
    const Eigen::VectorXd residual = left_out_residual(model, one, whole.parameters, options.fit);
    out.mean_square.push_back(residual.squaredNorm() / static_cast<double>(residual.size()) / variance);
    for (const double one_residual : residual) sizes.push_back(std::abs(one_residual));
  }
  out.prediction_bound = quantile(std::move(sizes), 0.95);
  return out;
}

}  // namespace sprung::identification
