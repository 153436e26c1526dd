#include "robots/overlay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "robots/parameters.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Overlay : public testing::Test {
 protected:
  Overlay() { fs::copy(test::source_dir() + "/robots/pegasus/robot.yaml", robot_folder_); }
  RobotConfig load(const std::string& overlay) {
    std::ofstream(robot_folder_ + "/overlay.yaml") << overlay;
    return load_robot(robot_folder_);
  }
  std::string refusal(const std::string& overlay) {
    return test::refusal_of<std::runtime_error>([&] { (void)load(overlay); });
  }

  test::OwnFolder folder_{"overlay"};
  const std::string robot_folder_ = folder_.path();
  const RobotConfig file_ = load_robot("pegasus");
};

TEST_F(Overlay, ReplacesNumbersOfOnePresetEvenWhereTheyCameByLike) {
  const RobotConfig robot = load("presets: {best: {walk: {swing: {stiffness: {z: 2500 N/m}}}}}\n");
  EXPECT_EQ(robot.preset("best").walk.swing.stiffness_N_m[2], 2500.0);
  EXPECT_EQ(robot.preset("paper").walk.swing.stiffness_N_m[2],
            file_.preset("paper").walk.swing.stiffness_N_m[2]);
  ASSERT_EQ(robot.overlay.size(), 1u);
  EXPECT_EQ(robot.overlay[0].file, file_.preset("best").walk.swing.stiffness_N_m[2]);
}

TEST_F(Overlay, RangesStayThoseOfRobotYaml) {
  const RobotConfig robot = load("presets: {best: {compliance: {stiffness: {z: 6000 N/m}}}}\n");
  const auto all = parameters_of(robot, robot.preset("best"));
  const Parameter& one = all[parameter_named(all, "compliance.stiffness.z")];
  EXPECT_EQ(one.file, 3000.0);
  EXPECT_EQ(one.most, 6000.0);
}

TEST_F(Overlay, WhatIsWrongIsNamedWithFileAndLine) {
  EXPECT_THAT(refusal("presets:\n  best:\n    stand_length: 0.9 m\n"),
              AllOf(HasSubstr("overlay.yaml:3"), HasSubstr("out of range"), HasSubstr("0.54075")));
  EXPECT_THAT(refusal("presets: {best: {stand_length: 500}}\n"), HasSubstr("expected a number in 'm'"));
  EXPECT_THAT(refusal("presets: {best: {stand_lenth: 0.5 m}}\n"), HasSubstr("did you mean"));
  EXPECT_THAT(refusal("cycle_rate: 100 Hz\n"), HasSubstr("no parameter that an overlay may change"));
  EXPECT_THAT(refusal("gaits: {trot: {fastest: {forward: 0.5 m/s}}}\n"), HasSubstr("out of range"));
}

TEST_F(Overlay, IsReadBackToTheBit) {
  const auto all = parameters_of(file_, file_.preset("best"));
  std::vector<OverlaidNumber> numbers;
  for (const Parameter& one : all)
    numbers.push_back({path_of(one, "best"), one.unit, one.file, one.least + (one.most - one.least) / 3.0});
  const RobotConfig robot = load(overlay_text(numbers));
  ASSERT_EQ(robot.overlay.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    SCOPED_TRACE(robot.overlay[i].path);
    const auto same = [&](const OverlaidNumber& n) { return n.path == robot.overlay[i].path; };
    EXPECT_EQ(std::find_if(numbers.begin(), numbers.end(), same)->value, robot.overlay[i].value);
  }
  EXPECT_EQ(load(overlay_text({})).overlay.size(), 0u);
}

TEST_F(Overlay, LogHoldsItAndTellsTheTwoApart) {
  const RobotConfig robot = load("presets:\n  best: {stand_length: 0.5 m}\n");
  const RobotConfig logged = read_robot_text(robot_text(robot_folder_), "log");
  EXPECT_EQ(logged.preset("best").stand_length_m, 0.5);
  EXPECT_EQ(logged.hash, robot.hash);
  EXPECT_EQ(logged.hash, file_.hash) << "what is stored of this robot.yaml still holds";
  EXPECT_EQ(logged.overlay_hash, robot.overlay_hash);
  EXPECT_NE(robot.overlay_hash, 0);
  EXPECT_EQ(file_.overlay_hash, 0);
}

}  // namespace
}  // namespace sprung
