#pragma once
/// Which of several models the data support: the simplest one whose error on data it has not seen is not
/// clearly larger than the best one's. Pure.
#include <string>
#include <vector>

#include "estimator/identification/cross_validation.h"

namespace sprung::identification {

struct Candidate {
  std::string name;
  int parameters = 0;  ///< free ones
  CrossValidation validation;
};

struct Selection {
  std::size_t best = 0;  ///< smallest mean error
  std::size_t chosen = 0;
  std::string why;  ///< one sentence, with the numbers
};

/// What the rule is, for reports.
const char* selection_criterion();

/// @param candidates not empty, cross-validated on the same blocks.
Selection select(const std::vector<Candidate>& candidates);

}  // namespace sprung::identification
