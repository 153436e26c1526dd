#pragma once
/// Parameters of a JointModel: names, units, bounds, and starts scaled by the data. Pure.
#include <vector>

#include "estimator/identification/fit_model.h"
#include "estimator/identification/joint_terms.h"

namespace sprung::identification {

/// In this order: inertia; gravity_cos, gravity_sin where the load is not known, or only what a weight adds;
/// load_gain where it is a term; offset; the friction law's, as friction_of(terms); two of each ripple
/// harmonic.
/// @param data gives the unit and the scales of torque and speed.
std::vector<FitParameter> joint_parameters(const JointTerms& terms, const JointDataset& data);

}  // namespace sprung::identification
