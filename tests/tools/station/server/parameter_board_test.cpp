#include "tools/station/server/parameter_board.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

RobotAnswer told(std::int64_t id, int parameter, double value,
                 OperatorOutcome outcome = OperatorOutcome::kDone) {
  RobotAnswer out;
  out.request_id = id;
  out.outcome = outcome;
  out.parameter = parameter;
  out.parameter_value = value;
  return out;
}

class ParameterBoardTest : public testing::Test {
 protected:
  double value(int parameter) const { return board_.values_json()[static_cast<std::size_t>(parameter)]; }
  ParameterBoard board_{load_robot("pegasus"), "best"};
};

TEST_F(ParameterBoardTest, AsksForOneAfterTheOtherUntilNoneIsLeft) {
  EXPECT_FALSE(board_.question()) << "nobody looks";
  board_.ask_anew();
  ASSERT_TRUE(board_.question());
  EXPECT_EQ(board_.question()->parameter, 0);
  board_.asked(5);
  EXPECT_FALSE(board_.question()) << "one at a time";
  EXPECT_TRUE(board_.take(told(5, 3, 1.5)));
  EXPECT_EQ(value(3), 1.5);
  EXPECT_EQ(board_.question()->parameter, 4);
  board_.asked(6);
  EXPECT_FALSE(board_.take(told(6, -1, kNaN)));
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
  EXPECT_TRUE(board_.take(told(77, 2, 700.0)));
  EXPECT_FALSE(board_.take(told(77, 2, 700.0))) << "said twice";
  EXPECT_FALSE(board_.take(told(78, 2, 900.0, OperatorOutcome::kRefused)));
  EXPECT_FALSE(board_.take(told(79, 5000, 1.0)));
  EXPECT_EQ(value(2), 700.0);
}

TEST_F(ParameterBoardTest, TableAndValuesAreOfTheSameOrder) {
  const auto table = board_.table_json();
  ASSERT_EQ(table.size(), board_.values_json().size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_EQ(table[i]["file"], board_.values_json()[i]);
}

}  // namespace
}  // namespace sprung::station
