#include "tools/station/server/parameter_board.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

RobotAnswer told(std::int64_t id, const std::string& parameter, double value,
                 OperatorOutcome outcome = OperatorOutcome::kDone) {
  RobotAnswer out;
  out.request_id = id;
  out.outcome = outcome;
  out.parameter = parameter.empty() ? 0 : parameter_id(parameter);
  out.parameter_value = value;
  return out;
}

class ParameterBoardTest : public testing::Test {
 protected:
  double value(const std::string& name) const {
    return board_.values_json()[parameter_named(parameters_of(robot_, robot_.preset("best")), name)];
  }
  const RobotConfig robot_ = load_robot("pegasus");
  ParameterBoard board_{robot_, "best"};
};

TEST_F(ParameterBoardTest, AsksForOneAfterTheOtherUntilNoneIsLeft) {
  EXPECT_FALSE(board_.question()) << "nobody looks";
  board_.ask_anew();
  ASSERT_TRUE(board_.question());
  EXPECT_EQ(board_.question()->parameter, 0);
  board_.asked(5);
  EXPECT_FALSE(board_.question()) << "one at a time";
  EXPECT_TRUE(board_.take(told(5, "stand_length", 0.5)));
  EXPECT_EQ(value("stand_length"), 0.5);
  EXPECT_EQ(board_.question()->parameter, parameter_id("stand_length"));
  board_.asked(6);
  EXPECT_FALSE(board_.take(told(6, "", kNaN)));
  EXPECT_FALSE(board_.question());
}

TEST_F(ParameterBoardTest, ASecondPageDoesNotBeginAnewAndOneAfterASilenceDoes) {
  board_.ask_anew();
  board_.asked(5);
  board_.ask_anew();
  EXPECT_FALSE(board_.question());
  board_.give_up();
  EXPECT_FALSE(board_.question());
  board_.ask_anew();
  EXPECT_TRUE(board_.question());
}

TEST_F(ParameterBoardTest, WhatAnotherOperatorSetsIsShownAndWhatWasRefusedIsNot) {
  EXPECT_TRUE(board_.take(told(77, "compliance.stiffness.y", 700.0)));
  EXPECT_FALSE(board_.take(told(77, "compliance.stiffness.y", 700.0))) << "said twice";
  EXPECT_FALSE(board_.take(told(78, "compliance.stiffness.y", 900.0, OperatorOutcome::kRefused)));
  EXPECT_FALSE(board_.take(told(79, "of another robot", 1.0)));
  EXPECT_EQ(value("compliance.stiffness.y"), 700.0);
}

TEST_F(ParameterBoardTest, TableAndValuesAreOfTheSameOrder) {
  const auto table = board_.table_json();
  ASSERT_EQ(table.size(), board_.values_json().size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_EQ(table[i]["file"], board_.values_json()[i]);
}

}  // namespace
}  // namespace sprung::station
