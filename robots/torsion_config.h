#pragma once
/// What a joint's gear does between motor encoder and link encoder, as robot.yaml holds it.
#include <array>
#include <cstddef>

namespace sprung {

/// One harmonic of what the gear's teeth add to the link's angle (facts papers D7):
/// cosine cos(order a) + sine sin(order a), a the motor's angle where the joint's zero is zero.
struct KinematicErrorTerm {
  double order = 0.0;  ///< per motor turn; need not be whole
  double cosine_rad = 0.0;
  double sine_rad = 0.0;
};

struct GearTorsion {
  static constexpr std::size_t kMostTerms = 16;

  double stiffness_Nm_rad = 0.0;         ///< facts papers D8: K1
  double second_stiffness_Nm_rad = 0.0;  ///< beyond second_from_Nm
  double second_from_Nm = 0.0;           ///< 0: one stiffness for all
  double angle_std_rad = 0.0;  ///< of motor angle less link angle, once the kinematic error is removed
  std::array<KinematicErrorTerm, kMostTerms> kinematic_error{};
  std::size_t kinematic_terms = 0;
};

}  // namespace sprung
