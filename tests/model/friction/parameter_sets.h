#pragma once
/// For tests that try one parameter after the other.
#include "model/friction/friction_parameters.h"

namespace sprung::test {

/// The other way round than to_vector(). @param reference_temperature_C is not in the vector.
inline FrictionParameters from_vector(const FrictionVector& vector, double reference_temperature_C = 24.0) {
  FrictionParameters parameters;
  for (const FrictionParameterInfo& info : friction_parameter_table())
    parameters.*(info.member) = vector[static_cast<std::size_t>(info.index)];
  parameters.reference_temperature_C = reference_temperature_C;
  return parameters;
}

/// The poorest model that allows every term which these parameters switch on.
inline FrictionModelKind smallest_model(FrictionParameters parameters) {
  if (!(parameters.stribeck_Nm > 0.0)) {  // its shape then means nothing
    parameters.stribeck_speed_rad_s = info(FrictionParameter::kStribeckSpeed).off;
    parameters.stribeck_exponent = info(FrictionParameter::kStribeckExponent).off;
  }
  for (const FrictionModelKind kind : kFrictionModels) {
    if (to_vector(restricted(parameters, kind)) == to_vector(parameters)) return kind;
  }
  return FrictionModelKind::kPresliding;
}

}  // namespace sprung::test
