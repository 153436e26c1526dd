#pragma once
/// What the command line says about windows, parts and models, as a protocol. Pure.
#include <string>

#include "estimator/identification/identify_joint.h"

namespace sprung::identify {

struct ProtocolRequest {
  std::string window;  ///< "8:60"; "" = all
  double resample_Hz = 0.0;
  double smoothing_s = 0.0;
  std::string train;  ///< "0:0.25,0.5:0.75", fractions of the window
  std::string test;
  std::string models = "all";  ///< "all", or names joined by commas: "viscous+stribeck,coulomb"
  std::string robust = "huber";
  int blocks = 8;
};

/// @throws std::invalid_argument naming the option.
identification::Protocol protocol_of(const ProtocolRequest& request);

/// "viscous+load" as terms; "coulomb" has none. @throws std::invalid_argument naming the terms there are.
identification::JointTerms terms_of(const std::string& name);

}  // namespace sprung::identify
