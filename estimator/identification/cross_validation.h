#pragma once
/// How well a model says what it has not seen: blocks of the training part are left out in turn. Pure.
#include <vector>

#include "estimator/identification/least_squares.h"

namespace sprung::identification {

struct CrossValidationOptions {
  /// Contiguous blocks of equal length, each left out once. Contiguous, since neighbouring samples resemble
  /// each other: a sample left out alone is no test.
  int blocks = 8;
  FitOptions fit;
};

struct CrossValidation {
  std::vector<double> mean_square;  ///< of the residual in each block, over the variance of the training data
  /// The fit to the whole training part ends on a bound other than zero: the data ask for more than the term
  /// can mean (half of the friction from one direction, a load share beyond self-locking), so it stands for
  /// something else.
  bool out_of_bounds = false;
  /// What 95 % of the samples were off by at most while their block was left out, in the data's unit: how far
  /// a prediction of another recording alike may be off.
  double prediction_bound = 0.0;
  double r2() const;  ///< 1 - mean of mean_square
};

/// What `a` is worse by than `b`: mean over blocks and the standard error of that mean, as shares of the
/// variance. The same blocks for both, so that what is hard in a block drops out.
struct Difference {
  double mean = 0.0;
  double standard_error = 0.0;
};
Difference difference(const CrossValidation& a, const CrossValidation& b);

/// @throws std::invalid_argument where the data are too few for so many blocks.
CrossValidation cross_validate(const FitModel& model, const std::vector<FitPiece>& training,
                               const CrossValidationOptions& options);

/// Parameters that a fit can move.
int free_parameters(const FitModel& model);

}  // namespace sprung::identification
