#pragma once
/// The other way round than to_vector(): for tests that change one parameter after the other.
#include "model/friction/friction_parameters.h"

namespace sprung::test {

/// @param reference_temperature_C is not in the vector.
inline FrictionParameters from_vector(const FrictionVector& vector, double reference_temperature_C = 24.0) {
  FrictionParameters parameters;
  for (const FrictionParameterInfo& info : friction_parameter_table())
    parameters.*(info.member) = vector[static_cast<std::size_t>(info.index)];
  parameters.reference_temperature_C = reference_temperature_C;
  return parameters;
}

}  // namespace sprung::test
