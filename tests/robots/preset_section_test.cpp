#include "robots/preset_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// single_leg's robot.yaml with lines put before its first preset's keys; gone at the end.
class ChangedPreset : public testing::Test {
 protected:
  ChangedPreset() : folder_(test::temp_dir() + "sprung_preset") { fs::create_directories(folder_); }
  ~ChangedPreset() override { fs::remove_all(folder_); }

  PresetConfig paper_with(const std::string& lines) {
    std::ifstream in(test::source_dir() + "/robots/single_leg/robot.yaml");
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::size_t at = text.find("    compensated_friction: paper");
    EXPECT_NE(at, std::string::npos);
    text.insert(at, lines);
    std::ofstream(folder_ / "robot.yaml") << text;
    return load_robot(folder_.string()).preset("paper");
  }
  std::string complaint(const std::string& lines) {
    try {
      paper_with(lines);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

 private:
  fs::path folder_;
};

TEST_F(ChangedPreset, WhatMayBeMissingIsOff) {
  const PresetConfig paper = paper_with("");
  EXPECT_EQ(paper.inertia_compensation, 0.0);
  EXPECT_EQ(paper.stiffness_ramp_s, 0.0);
  EXPECT_EQ(paper.rest_friction.speed_rad_s, 0.0);
  EXPECT_EQ(paper.compliance.stiffness_N_m[0], 0.0);
}

TEST_F(ChangedPreset, ComplianceIsRead) {
  const PresetConfig paper = paper_with(
      "    inertia_compensation: 0.9\n    stiffness_ramp: 30 ms\n"
      "    rest_friction: {speed: 0.02 rad/s, torque: 0.1 Nm, most: 0.3}\n"
      "    compliance: {stiffness: {x: 2000 N/m, y: 0 N/m, z: 1500 N/m}, damping: {x: 4 N s/m, y: 0 N s/m, "
      "z: 5 "
      "N s/m}, velocity_feedforward: 0}\n");
  EXPECT_EQ(paper.inertia_compensation, 0.9);
  EXPECT_EQ(paper.stiffness_ramp_s, 0.03);
  EXPECT_EQ(paper.rest_friction.speed_rad_s, 0.02);
  EXPECT_EQ(paper.rest_friction.torque_Nm, 0.1);
  EXPECT_EQ(paper.rest_friction.most, 0.3);
  EXPECT_EQ(paper.compliance.stiffness_N_m[2], 1500.0);
  EXPECT_EQ(paper.compliance.damping_N_s_m[0], 4.0);
}

TEST_F(ChangedPreset, UnknownKeysAndWrongRangesAreNamed) {
  EXPECT_THAT(complaint("    inertia_compensation: 1.5\n"), HasSubstr("inertia_compensation"));
  EXPECT_THAT(complaint("    rest_friction: {speed: 0.02 rad/s}\n"), HasSubstr("torque"));
  EXPECT_THAT(complaint("    stiffness_ram: 1 ms\n"), HasSubstr("stiffness_ram"));
}

}  // namespace
}  // namespace sprung
