#include "robots/torsion_section.h"

#include <string>

namespace sprung::robot_sections {
namespace {

constexpr double kSoftest_Nm_rad = 1.0, kHardest_Nm_rad = 1e7;

KinematicErrorTerm read_term(const YamlMap& map) {
  KinematicErrorTerm term;
  term.order = map.quantity("order", "", 1e-3, 1000);
  term.cosine_rad = map.quantity("cosine", "rad", -0.1, 0.1);
  term.sine_rad = map.quantity("sine", "rad", -0.1, 0.1);
  map.finish();
  return term;
}

void read_kinematic_error(const YamlMap& map, GearTorsion& torsion) {
  for (const YamlMap& term : map.list("kinematic_error")) {
    if (torsion.kinematic_terms == GearTorsion::kMostTerms)
      map.fail("kinematic_error", "expected at most " + std::to_string(GearTorsion::kMostTerms) + " terms");
    torsion.kinematic_error[torsion.kinematic_terms++] = read_term(term);
  }
}

}  // namespace

GearTorsion read_torsion(const YamlMap& map) {
  GearTorsion torsion;
  torsion.stiffness_Nm_rad = map.quantity("stiffness", "Nm/rad", kSoftest_Nm_rad, kHardest_Nm_rad);
  torsion.second_stiffness_Nm_rad = torsion.stiffness_Nm_rad;
  if (map.has("second_stiffness") != map.has("second_from"))
    map.fail("second_stiffness", "second_stiffness and second_from belong together");
  if (map.has("second_stiffness")) {
    torsion.second_stiffness_Nm_rad = map.quantity("second_stiffness", "Nm/rad", kSoftest_Nm_rad,
                                                   kHardest_Nm_rad);
    torsion.second_from_Nm = map.quantity("second_from", "Nm", 0, 1e4);
  }
  torsion.angle_std_rad = map.quantity("angle_std", "rad", 1e-9, 0.1);
  if (map.has("kinematic_error")) read_kinematic_error(map, torsion);
  map.finish();
  return torsion;
}

}  // namespace sprung::robot_sections
