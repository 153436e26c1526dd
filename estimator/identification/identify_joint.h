#pragma once
/// From one joint's recording to fitted, scored and compared models. Pure.
///
/// The training part is prepared from its own samples alone and decides everything: parameters, standard
/// errors, choice. The test part is only scored.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "estimator/identification/cross_validation.h"
#include "estimator/identification/fit_statistics.h"
#include "estimator/identification/joint_model.h"
#include "estimator/identification/model_selection.h"
#include "estimator/identification/raw_series.h"

namespace sprung::identification {

/// Which models of a joint are tried: the named friction models, so that every report compares them, and what
/// a forward search over terms finds from the simplest one on. Sees training data only.
struct SearchOptions {
  CrossValidationOptions validation;
  int most_parameters = 14;      ///< free ones
  std::vector<JointTerms> only;  ///< not empty: these models and no search
};

struct TriedModel {
  std::shared_ptr<const JointModel> model;
  CrossValidation validation;
};

/// Coulomb; + viscous; + Stribeck; + load and asymmetry; + presliding.
std::vector<JointTerms> named_models();

/// A term is added while one lessens the mean error on left-out blocks and stays within its bounds; of
/// several the one that lessens it most.
/// @param progress called with the name of the model that is tried next; may be empty.
std::vector<TriedModel> search_models(const std::vector<FitPiece>& training, const SearchOptions& options,
                                      const std::function<void(const std::string&)>& progress = {});

struct Protocol {
  TimeSpan window{0.0, 1e9};  ///< seconds after the first sample; cut off at the recording's end
  std::vector<TimeSpan> train{{0.0, 0.5}};  ///< fractions of the window
  std::vector<TimeSpan> test{{0.5, 1.0}};
  PrepareOptions prepare;
  SearchOptions search;
};

struct ModelResult {
  std::shared_ptr<const JointModel> model;
  Fit fit;
  FitStatistics statistics;
  CrossValidation validation;
  FitScore train;
  FitScore held_out;
  int free_parameters = 0;
};

struct JointResult {
  std::vector<ModelResult> models;  ///< named ones first
  std::size_t chosen = 0;
  std::string why;
  std::vector<FitPiece> training;  ///< what the models were fitted to
  std::vector<FitPiece> test;      ///< the whole window; weights say which samples are scored
  double from_s = 0.0;             ///< window, as it was cut off
  double to_s = 0.0;
};

/// @param progress as search_models().
/// @throws std::invalid_argument naming the problem: parts that overlap, too few samples, prepare()'s.
JointResult identify_joint(const RawSeries& series, const Protocol& protocol,
                           const std::function<void(const std::string&)>& progress = {});

}  // namespace sprung::identification
