#pragma once
/// What every reader of a robot's files throws.
#include <stdexcept>

namespace sprung {

/// A mistake in a robot file; what() reads "robots/x/robot.yaml:12: key 'a.b': found ..., expected ...".
struct ConfigError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sprung
