#include <gtest/gtest.h>

#include <string>

#include "robots/robot_loader.h"
#include "robots/robot_sections.h"

namespace sprung {
namespace {

GearTorsion torsion_section_read(const std::string& text) {
  return robot_sections::read_torsion(YamlMap::parse(text, "robot.yaml"));
}

std::string refused(const std::string& text) {
  try {
    (void)torsion_section_read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(TorsionSectionTest, ReadsStiffnessesAndHarmonics) {
  const GearTorsion gear = torsion_section_read(
      "{stiffness: 25000 Nm/rad, second_stiffness: 34000 Nm/rad, second_from: 14 Nm, angle_std: 0.00002 rad, "
      "kinematic_error: [{order: 2, cosine: 0.00001 rad, sine: 0.00029 rad}, {order: 0.98, cosine: 0 rad, "
      "sine: 1e-5 rad}]}");
  EXPECT_EQ(gear.stiffness_Nm_rad, 25000.0);
  EXPECT_EQ(gear.second_stiffness_Nm_rad, 34000.0);
  EXPECT_EQ(gear.second_from_Nm, 14.0);
  EXPECT_EQ(gear.angle_std_rad, 2e-5);
  ASSERT_EQ(gear.kinematic_terms, 2u);
  EXPECT_EQ(gear.kinematic_error[0].sine_rad, 0.00029);
  EXPECT_EQ(gear.kinematic_error[1].order, 0.98);
}

TEST(TorsionSectionTest, OneStiffnessIsEnough) {
  const GearTorsion gear = torsion_section_read("{stiffness: 31000 Nm/rad, angle_std: 0.00002 rad}");
  EXPECT_EQ(gear.second_stiffness_Nm_rad, 31000.0);
  EXPECT_EQ(gear.second_from_Nm, 0.0);
  EXPECT_EQ(gear.kinematic_terms, 0u);
}

TEST(TorsionSectionTest, WhatCannotBeIsRefusedByKey) {
  EXPECT_NE(refused("{angle_std: 0.00002 rad}").find("stiffness"), std::string::npos);
  EXPECT_NE(refused("{stiffness: 31000 Nm/rad}").find("angle_std"), std::string::npos);
  EXPECT_NE(refused("{stiffness: -1 Nm/rad, angle_std: 0.00002 rad}").find("stiffness"), std::string::npos);
  EXPECT_NE(refused("{stiffness: 9 Nm/rad, second_from: 2 Nm, angle_std: 0.1 rad}").find("second_stiffness"),
            std::string::npos);
  EXPECT_NE(refused("{stiffness: 9 Nm/rad, angle_std: 0.1 rad, damping: 3}").find("damping"),
            std::string::npos);
  std::string many = "{stiffness: 9 Nm/rad, angle_std: 0.1 rad, kinematic_error: [";
  for (int i = 0; i < 17; ++i) many += "{order: 1, cosine: 0 rad, sine: 0 rad},";
  EXPECT_NE(refused(many + "]}").find("at most 16"), std::string::npos);
}

}  // namespace
}  // namespace sprung
