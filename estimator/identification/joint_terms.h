#pragma once
/// What a model of a joint is made of: terms that identification adds one after another. Pure values.
#include <string>
#include <vector>

#include "estimator/identification/dataset.h"
#include "model/friction/friction_parameters.h"

namespace sprung::identification {

/// Every model has inertia, offset and Coulomb friction, and gravity or a known load. What may be added, each
/// a group of parameters that makes sense only as a whole:
enum class JointTerm {
  kViscous,      ///< viscous
  kStribeck,     ///< stribeck, stribeck_speed
  kLoad,         ///< load_share_driving, load_share_driven
  kAsymmetry,    ///< asymmetry of the dry part
  kPresliding,   ///< presliding: hysteresis (friction/presliding_state.h) in the place of the sign of motion
  kShear,        ///< viscous_exponent; needs kViscous
  kTemperature,  ///< viscous_temperature; needs kViscous and a dataset that has temperature
  kLoadGain,     ///< load_gain: torque constant and ratio; needs a dataset that has load
  kRipple1,      ///< ripple_1_cos, ripple_1_sin: once a turn of the motor (wave generator that is not round)
  kRipple2,      ///< twice: the wave generator's two lobes, the largest (docs/sources.md, facts D7)
  kRipple4,      ///< four times
};

using JointTerms = std::vector<JointTerm>;

bool has(const JointTerms& terms, JointTerm term);
/// "viscous", "stribeck", ..., "ripple_2".
const char* name(JointTerm term);
/// "coulomb" alone, or the terms joined by "+": "viscous+load".
std::string name(const JointTerms& terms);

/// Terms that this dataset can have at all, in the order of JointTerm.
JointTerms possible_terms(const JointDataset& data);
/// The model has everything that this term builds on.
bool can_follow(const JointTerms& terms, JointTerm next);

/// Parameters of the friction law that the terms bring in.
std::vector<FrictionParameter> friction_of(const JointTerms& terms);
/// Harmonics of the motor angle, ascending.
std::vector<int> ripple_harmonics(const JointTerms& terms);

}  // namespace sprung::identification
