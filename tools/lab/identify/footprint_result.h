#pragma once
/// `--footprint`: what the encoders on both sides of the gear differ by besides torsion. Pure.
#include <optional>

#include "estimator/identification/footprint.h"
#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// Fitted to the training part, scored on the test part: torsion alone and with the kinematic error taken
/// off. Where the load is not known it is what the chosen model makes of the motor's torque.
/// @throws std::invalid_argument without a second encoder, or with torques in amperes.
FootprintResult footprint_of(const IdentifiedJoint& joint, const identification::FitOptions& options);

std::string footprint_table(const FootprintResult& result);

}  // namespace sprung::identify
