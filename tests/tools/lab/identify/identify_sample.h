#pragma once
/// A knee of single_leg that was identified from made-up motion, with known parameters.
#include <cmath>

#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

struct SampleTruth {
  double armature_kg_m2 = 0.75;
  double gravity_Nm = 2.5;  ///< sine of the knee's angle
  double coulomb_Nm = 6.0;
  double viscous_Nm_s_rad = 3.0;
};

/// @param links_kg_m2 added to the armature.
inline identification::RawSeries sample_series(const SampleTruth& truth, double links_kg_m2) {
  identification::RawSeries out;
  out.gear_ratio = 100.0;
  for (int i = 0; i < 6000; ++i) {
    const double t = 0.005 * i, slow = 0.9, fast = 3.7;
    const double q = 1.2 + 0.6 * std::sin(slow * t) + 0.1 * std::sin(fast * t);
    const double w = 0.6 * slow * std::cos(slow * t) + 0.1 * fast * std::cos(fast * t);
    const double a = -0.6 * slow * slow * std::sin(slow * t) - 0.1 * fast * fast * std::sin(fast * t);
    // A little that is in no model, so that residuals are not zero.
    const double unexplained = 0.05 * std::sin(7919.0 * t);
    out.time_s.push_back(t);
    out.position_rad.push_back(q);
    out.measured_torque.push_back((truth.armature_kg_m2 + links_kg_m2) * a + truth.gravity_Nm * std::sin(q) +
                                  truth.coulomb_Nm * std::tanh(w / 1e-3) + truth.viscous_Nm_s_rad * w +
                                  unexplained);
  }
  return out;
}

inline IdentifiedJoint sample_joint(const identification::RawSeries& series,
                                    const std::vector<identification::JointTerms>& models = {
                                        {}, {identification::JointTerm::kViscous}}) {
  identification::Protocol protocol;
  protocol.search.validation.blocks = 4;
  protocol.search.only = models;
  IdentifiedJoint out;
  out.name = "knee";
  out.result = identification::identify_joint(series, protocol);
  return out;
}

inline Provenance sample_provenance() {
  return {"logs/knee.lcm", "0123456789abcdef", "2026-11-21", "sprung identify --log logs/knee.lcm"};
}

}  // namespace sprung::identify
