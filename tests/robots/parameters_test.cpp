#include "robots/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "robots/robot_loader.h"
#include "tests/support/changed_robot.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class Parameters : public testing::Test {
 protected:
  const Parameter& named(const std::string& name) const { return all_[parameter_named(all_, name)]; }
  RobotConfig robot_ = load_robot("pegasus");
  std::vector<Parameter> all_ = parameters_of(robot_, robot_.preset("best"));
};

TEST_F(Parameters, OfEveryRobotAndPresetAreDeclaredOnceWithUnitRangeAndMeaning) {
  for (const char* name : {"pegasus", "single_leg", "fennec"}) {
    const RobotConfig robot = load_robot(name);
    for (const PresetConfig& preset : robot.presets) {
      std::set<std::string> names;
      std::set<std::int64_t> ids;
      for (const Parameter& one : parameters_of(robot, preset)) {
        SCOPED_TRACE(one.name);
        EXPECT_TRUE(names.insert(one.name).second);
        EXPECT_TRUE(ids.insert(one.id).second);
        EXPECT_EQ(one.id, parameter_id(one.name));
        EXPECT_EQ(static_cast<std::int64_t>(static_cast<double>(one.id)), one.id) << "exact in scripts";
        EXPECT_FALSE(one.meaning.empty());
        EXPECT_LT(one.least, one.most);
        EXPECT_TRUE(one.allows(one.file)) << "robot.yaml's own is always allowed";
        if (one.tightens_only) {
          EXPECT_TRUE(one.file == one.least || one.file == one.most);
        }
      }
      EXPECT_GE(names.size(), 8u);
    }
  }
}

/// The name is the way in robot.yaml, and the unit is the one that stands there.
TEST_F(Parameters, StandInRobotYamlWhereTheyAreNamed) {
  for (const char* name : {"pegasus", "single_leg", "fennec"}) {
    const RobotConfig robot = load_robot(name);
    const YamlMap file = YamlMap::load(robot.folder + "/robot.yaml");
    for (const PresetConfig& preset : robot.presets) {
      for (const Parameter& one : parameters_of(robot, preset)) {
        SCOPED_TRACE(path_of(one, preset.name));
        const auto [value, unit] = file.quantity_at(path_of(one, preset.name));
        EXPECT_DOUBLE_EQ(value, one.file);
        EXPECT_EQ(unit, one.unit);
      }
    }
  }
}

TEST_F(Parameters, EachIsANumberOfItsOwn) {
  AdjustableConfig config = adjustable_of(robot_, robot_.preset("best"));
  for (const Parameter& one : all_) one.at(config) = -1.0 - static_cast<double>(&one - all_.data());
  for (const Parameter& one : all_)
    EXPECT_EQ(one.at(config), -1.0 - static_cast<double>(&one - all_.data())) << one.name;
}

TEST_F(Parameters, LimitsMayOnlyBeTightened) {
  EXPECT_EQ(named("gaits.trot.fastest.forward").most, 0.4);
  EXPECT_EQ(named("gaits.trot.fastest.backward").most, 0.28);
  EXPECT_EQ(named("body.fallen.tilt").most, 0.7);
  EXPECT_EQ(named("body.fallen.height").least, 0.25);
  EXPECT_TRUE(named("walk.acceleration").tightens_only);
  EXPECT_FALSE(named("compliance.stiffness.z").tightens_only);
}

TEST_F(Parameters, WhatIsNoneIsNamedWithTheNearest) {
  EXPECT_THAT(test::refusal_of<std::invalid_argument>([&] { (void)named("stand_lenght"); }),
              HasSubstr("did you mean 'stand_length'"));
}

TEST_F(Parameters, RobotWithoutFeetHasNone) {
  const RobotConfig axis = load_robot("test_axis");
  EXPECT_TRUE(parameters_of(axis, axis.preset()).empty());
}

}  // namespace
}  // namespace sprung
