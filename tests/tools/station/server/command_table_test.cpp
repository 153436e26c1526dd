#include "tools/station/server/command_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

class Forms : public testing::Test {
 protected:
  static std::vector<std::string> names(const std::vector<OperatorForm>& forms) {
    std::vector<std::string> out;
    for (const OperatorForm& form : forms) out.push_back(form.name);
    return out;
  }
  OperatorCommand command(const char* name, const Json& parameters, const RobotNow& now = {}) const {
    return command_of(form_named(forms_, name), robot_, now, parameters);
  }
  /// What it says where it refuses.
  std::string refused(const char* name, const Json& parameters) const {
    try {
      command(name, parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  const RobotConfig robot_ = load_robot("pegasus");
  const std::vector<OperatorForm> forms_ = operator_forms(robot_, "best");
};

TEST_F(Forms, ARobotHasThoseThatItCanDo) {
  EXPECT_THAT(names(forms_), ElementsAre("stand", "walk", "comply", "stop", "set_parameter", "sit", "move",
                                         "home", "clear"));
  EXPECT_THAT(names(operator_forms(load_robot("single_leg"), "best")),
              ElementsAre("stand", "jump", "comply", "land", "stop", "set_parameter", "sit", "move", "home",
                          "clear"));
  EXPECT_THAT(names(operator_forms(load_robot("test_axis"), "")),
              ElementsAre("sit", "move", "home", "clear"));
}

TEST_F(Forms, EveryFormMakesACommandAsItStands) {
  const RobotConfig leg = load_robot("single_leg");
  for (const OperatorForm& form : operator_forms(leg, "best")) {
    const Json parameters = form.name == "move"            ? Json{{"by_deg", 5}}
                            : form.name == "set_parameter" ? Json{{"value", 0.5}}
                                                           : Json::object();
    const OperatorCommand command = command_of(form, leg, {{0.0, 0.0}, -1}, parameters);
    EXPECT_EQ(command.kind, form.kind) << form.name;
  }
}

TEST_F(Forms, NumbersComeInTheCommandsUnits) {
  const RobotConfig leg = load_robot("single_leg");
  const auto forms = operator_forms(leg, "best");
  const auto jump = command_of(form_named(forms, "jump"), leg, {},
                               {{"height_mm", 150}, {"count", 3}, {"mode", "adaptive"}});
  EXPECT_DOUBLE_EQ(jump.jump_height_m, 0.15);
  EXPECT_EQ(jump.jump_count, 3);
  EXPECT_EQ(jump.jump_mode, JumpMode::kAdaptive);
  const auto move = command("move", {{"joint", "fr_knee"}, {"by_deg", 5}},
                            {std::vector<double>(12, 1.0), -1});
  EXPECT_EQ(robot_.joints[move.joint].name, "fr_knee");
  EXPECT_NEAR(move.joint_target_rad, 1.0 + 0.0872664626, 1e-9);
  EXPECT_GT(move.joint_speed_rad_s, 0.0);
  EXPECT_TRUE(std::isnan(command("comply", Json::object()).stiffness_N_m[0])) << "empty: the preset's";
}

TEST_F(Forms, WalkHasHeightAndWidthAndMoveItsAcceleration) {
  const auto walk = command("walk", {{"height_mm", 330}, {"width_mm", 20}});
  EXPECT_DOUBLE_EQ(walk.body_height_m, 0.33);
  EXPECT_DOUBLE_EQ(walk.stance_width_m, 0.02);
  const auto plain = command("walk", Json::object());
  EXPECT_TRUE(std::isnan(plain.body_height_m)) << "the gait's or the preset's";
  EXPECT_TRUE(std::isnan(plain.stance_width_m));
  EXPECT_THAT(refused("walk", {{"height_mm", 50}}), HasSubstr("hips over feet must be"));
  EXPECT_THAT(refused("walk", {{"width_mm", 151}}), HasSubstr("feet further out must be -50 to 150 mm"));
  const auto move = command("move", {{"to_deg", 5}, {"speed_deg_s", 10}, {"acceleration_deg_s2", 90}});
  EXPECT_NEAR(move.joint_acceleration_rad_s2, 1.57079633, 1e-8);
  const auto gentle = command("move", {{"to_deg", 5}, {"speed_deg_s", 10}});
  EXPECT_NEAR(gentle.joint_speed_rad_s / gentle.joint_acceleration_rad_s2, 0.25, 1e-9);
}

TEST_F(Forms, WhatIsWrongIsNamedWithItsRange) {
  EXPECT_THAT(refused("walk", {{"forward_m_s", 9}}), HasSubstr("forward must be -0.28 to 0.4 m/s, not 9"));
  EXPECT_THAT(refused("walk", {{"gait", "gallop"}}),
              HasSubstr("gait must be one of fitting stand crawl walk trot"));
  EXPECT_THAT(refused("walk", {{"gait", "crawl"}, {"forward_m_s", 0.4}}), HasSubstr("crawl does not go"));
  EXPECT_THAT(refused("walk", {{"speed", 1}}), HasSubstr("walk has no parameter 'speed'"));
  EXPECT_THAT(refused("walk", {{"forward_m_s", "fast"}}), HasSubstr("forward must be a number"));
  EXPECT_THAT(refused("walk", {{"forward_m_s", nullptr}}), HasSubstr("forward must be a number"));
  EXPECT_THAT(refused("walk", Json::array()), HasSubstr("must be an object"));
  EXPECT_THAT(refused("move", Json::object()), HasSubstr("either to or by"));
  EXPECT_THAT(refused("move", {{"by_deg", 5}}), HasSubstr("nobody says where the joint is"));
  EXPECT_THROW(form_named(forms_, "explode"), std::invalid_argument);
}

TEST_F(Forms, HomeOfAllAndOfOne) {
  EXPECT_EQ(command("home", Json::object()).actuator, -1);
  const auto one = command("home", {{"actuator", "fl_hip_motor"}, {"from", "link"}});
  EXPECT_EQ(robot_.actuators[one.actuator].name, "fl_hip_motor");
  EXPECT_EQ(one.reference_source, ReferenceSource::kLink);
}

TEST_F(Forms, TheJsonHasARangeOrChoicesForEachParameter) {
  for (const Json& form : Json::parse(forms_json(forms_).dump())) {
    for (const Json& parameter : form["parameters"])
      EXPECT_TRUE(parameter.contains("choices") || parameter["low"] < parameter["high"]) << parameter.dump();
  }
}

}  // namespace
}  // namespace sprung::station
