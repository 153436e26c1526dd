#pragma once
/// One joint's identification with all that its output says beside the numbers. Pure values.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "estimator/identification/identify_joint.h"

namespace sprung::identify {

/// Where data came from, and what brings the result about again.
struct Provenance {
  std::string file;
  std::string sha256;   ///< first 16 hexadecimal digits
  std::string date;     ///< of the identification, 2026-11-21
  std::string command;  ///< the whole line
  /// Of the recording, as somebody has said; NaN: nobody has.
  double temperature_C = std::numeric_limits<double>::quiet_NaN();
  double supply_V = std::numeric_limits<double>::quiet_NaN();
};

/// Inertia of the rotor as seen from the joint: what was fitted less what robot.yaml says of the links.
struct Armature {
  double value_kg_m2 = 0.0;
  double standard_error_kg_m2 = 0.0;
  double links_kg_m2 = 0.0;  ///< about this joint at the recorded pose
  std::string note;          ///< how it came about, one sentence
};

/// What the motor's torque constant would have to be, over robot.yaml's: a weight is the scale.
struct TorqueConstant {
  double factor = 1.0;
  double standard_error = 0.0;
  bool by_known_weight = false;  ///< one at the foot; else that of the links, as robot.yaml has it
};

/// One model of the difference between the encoders of both sides.
struct FootprintFit {
  std::string name;  ///< "torsion", or "footprint": with the kinematic error
  std::vector<identification::FitParameter> parameters;
  identification::Fit fit;
  identification::FitStatistics statistics;
  identification::FitScore held_out;  ///< rad
  double held_out_torque_rms_Nm = 0.0;
  double stiffness_Nm_rad = 0.0;
};
using FootprintResult = std::vector<FootprintFit>;  ///< simple one first

struct IdentifiedJoint {
  std::string name;  ///< "" where a table does not say
  identification::JointResult result;
  std::optional<Armature> armature;  ///< nothing where it cannot be told from the links
  std::optional<TorqueConstant> torque_constant;
  FootprintResult footprint;       ///< empty where nobody asked
  std::vector<std::string> notes;  ///< on the recording, one sentence each

  const identification::ModelResult& chosen() const { return result.models[result.chosen]; }
};

}  // namespace sprung::identify
