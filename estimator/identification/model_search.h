#pragma once
/// Which models of a joint are tried: the named friction models, so that every report compares them, and what
/// a forward search over terms finds from the simplest one on. Sees training data only. Pure.
#include <functional>
#include <memory>
#include <vector>

#include "estimator/identification/cross_validation.h"
#include "estimator/identification/joint_model.h"

namespace sprung::identification {

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

}  // namespace sprung::identification
