#pragma once
/// What a fit's user must know, in plain words. Pure.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/identification/fit_model.h"
#include "estimator/identification/fit_statistics.h"

namespace sprung::identification {

/// @param hidden directions in parameters, each of length 1, along which the fit does not change at all.
std::vector<std::string> fit_warnings(const std::vector<FitParameter>& parameters, const Fit& fit,
                                      const FitStatistics& statistics,
                                      const std::vector<Eigen::VectorXd>& hidden);

}  // namespace sprung::identification
