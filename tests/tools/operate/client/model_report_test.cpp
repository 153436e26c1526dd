#include "tools/operate/client/model_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "signals/modes.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ModelReport : public testing::Test {
 protected:
  ModelReport() {
    for (JointConfig& joint : robot_.joints) joint.friction->record.date = "2026-11-21";
    state_.n_joints = static_cast<int>(robot_.joints.size());
    state_.joints.resize(robot_.joints.size());
    for (auto& joint : state_.joints) {
      joint.model.model_fits = joint.identified = 1;
      joint.heat.derating_in_s = std::nan("");
    }
  }
  void doubt_knee() {
    state_.joints[1].model.model_fits = 0;
    state_.joints[1].model.misfit_ratio = 6.25;
    state_.joints[1].model.misfit_reason = static_cast<std::int8_t>(MisfitReason::kViscousFriction);
  }

  RobotConfig robot_ = load_robot("single_leg");
  sprung_msgs::joint_state_t state_{};
};

TEST_F(ModelReport, NothingHeardTellsNothing) {
  EXPECT_EQ(models_json(robot_, std::nullopt), Json::array());
  EXPECT_THAT(model_lines(Json::array()), IsEmpty());
}

TEST_F(ModelReport, ModelsThatFitAreInTheJsonAlone) {
  const Json models = models_json(robot_, state_);
  ASSERT_EQ(models.size(), 2u);
  EXPECT_EQ(models[0]["name"], "hip");
  EXPECT_EQ(models[0]["fits"], true);
  EXPECT_EQ(models[0]["likely_reason"], "none");
  EXPECT_TRUE(models[0]["repeat"].is_null());
  EXPECT_THAT(model_lines(models), IsEmpty());
}

TEST_F(ModelReport, MisfitIsToldWithJointLikelyReasonAndRemedy) {
  doubt_knee();
  const Json models = models_json(robot_, state_);
  EXPECT_EQ(
      models[1]["repeat"],
      "sprung identify --record single_leg knee --suspended --loaded --out knee.lcm, and once more with "
      "--weight 5kg, clamped to its foot");
  EXPECT_THAT(model_lines(models),
              ElementsAre(AllOf(HasSubstr("knee"), HasSubstr("viscous friction"), HasSubstr("6.2 times"),
                                HasSubstr("sprung identify --record single_leg knee"))));
}

TEST_F(ModelReport, MotorsThatWillBeLimitedSoonAreTold) {
  state_.joints[0].heat = {0.85, 12.4};
  state_.joints[1].heat = {0.3, 500.0};
  EXPECT_THAT(model_lines(models_json(robot_, state_)),
              ElementsAre(AllOf(HasSubstr("hip"), HasSubstr("85 %"), HasSubstr("in 12 s"))));
  state_.joints[0].heat = {1.01, 0.0};
  EXPECT_THAT(model_lines(models_json(robot_, state_)), IsEmpty()) << "its drive's line says so";
  state_.joints[0].heat = {std::nan(""), std::nan("")};
  const Json unknown = models_json(robot_, state_);
  EXPECT_THAT(model_lines(unknown), IsEmpty());
  EXPECT_TRUE(unknown[0]["winding_share"].is_null());
}

TEST_F(ModelReport, IdentificationsWithinTheirAgeAreNotTold) {
  EXPECT_THAT(doubtful_identifications(robot_, "2026-11-21"), IsEmpty());
  EXPECT_THAT(doubtful_identifications(robot_, "2027-02-19"), IsEmpty()) << "90 days";
}

TEST_F(ModelReport, OldIdentificationsAreToldWithTheirJointsAndRemedy) {
  EXPECT_THAT(
      doubtful_identifications(robot_, "2027-02-20"),
      ElementsAre(AllOf(HasSubstr("91 days ago"), HasSubstr("max_age_days: 90"), HasSubstr("hip, knee"),
                        HasSubstr("sprung identify --record single_leg hip"))));
  robot_.joints[0].friction->record.max_age_days = 400;
  EXPECT_THAT(doubtful_identifications(robot_, "2027-02-20"), ElementsAre(HasSubstr(": knee;")));
}

TEST_F(ModelReport, WhatWasIdentifiedOnAnotherRobotIsToldWithTheRemedy) {
  robot_.name = "my_leg";
  EXPECT_THAT(doubtful_identifications(robot_, "2026-11-21"),
              ElementsAre(AllOf(HasSubstr("identified on single_leg"), HasSubstr(": hip, knee;"),
                                HasSubstr("sprung identify --record my_leg hip"))));
}

TEST_F(ModelReport, OldZerosAreToldWithTheirActuators) {
  EXPECT_EQ(robot_.actuators[0].referenced_on, "2026-11-21");
  EXPECT_THAT(doubtful_zeros(robot_, "2027-11-21"), IsEmpty());
  EXPECT_THAT(doubtful_zeros(robot_, "2027-11-22"),
              ElementsAre(AllOf(HasSubstr("366 days ago"), HasSubstr("hip_motor, knee_motor"))));
  robot_.actuators[0].referenced_on.clear();
  EXPECT_THAT(doubtful_zeros(robot_, "2027-11-22"), ElementsAre(HasSubstr(": knee_motor;")));
}

TEST_F(ModelReport, LeapDayCounts) {
  for (JointConfig& joint : robot_.joints) joint.friction->record.date = "2028-02-01";
  EXPECT_THAT(doubtful_identifications(robot_, "2028-05-01"), IsEmpty()) << "29 + 31 + 30 days";
  EXPECT_THAT(doubtful_identifications(robot_, "2028-05-02"), ElementsAre(HasSubstr("91 days")));
}

TEST_F(ModelReport, JointsThatAreNotIdentifiedHaveNoAge) {
  for (JointConfig& joint : robot_.joints) joint.friction.reset();
  EXPECT_THAT(doubtful_identifications(robot_, "2099-01-01"), IsEmpty());
}

}  // namespace
}  // namespace sprung
