#include "simulation/node/error_record.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "drivers/canopen/objects.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

class ErrorRecordTest : public testing::Test {
 protected:
  std::int64_t history(int sub) const {
    return dictionary_.get({canopen::kErrorHistory, static_cast<std::uint8_t>(sub)});
  }
  std::int64_t error_register() const { return dictionary_.get({canopen::kErrorRegister, 0}); }

  ObjectDictionary dictionary_{load_eds("epos2", 1)};
  ErrorRecord errors_{dictionary_};
};

/// Facts canopen 2.5, column "reg", with the generic bit (facts canopen 4.7).
TEST(ErrorRegister, BitsFollowTheErrorsClass) {
  const std::vector<std::pair<int, int>> rows = {
      {0x1000, 0x01}, {0x2310, 0x02}, {0x3210, 0x04}, {0x3220, 0x04}, {0x4210, 0x08}, {0x5113, 0x04},
      {0x5114, 0x04}, {0x6100, 0x20}, {0x6320, 0x20}, {0x7320, 0x20}, {0x8110, 0x10}, {0x8120, 0x10},
      {0x8130, 0x10}, {0x8150, 0x10}, {0x81FD, 0x10}, {0x81FE, 0x10}, {0x8210, 0x10}, {0x8611, 0x20},
      {0xFF01, 0x80}, {0xFF06, 0x80}, {0xFF09, 0x80}, {0xFF0A, 0x80}, {0xFF0B, 0x20}};
  for (const auto& [code, bits] : rows)
    EXPECT_EQ(register_bits(static_cast<std::uint16_t>(code)), bits | 0x01) << std::hex << code;
  EXPECT_EQ(register_bits(0), 0);
}

TEST_F(ErrorRecordTest, RegisterIsTheOrOfWhatStands) {
  EXPECT_TRUE(errors_.raise(0x3220));
  EXPECT_TRUE(errors_.raise(0x8130));
  EXPECT_EQ(error_register(), 0x15);
  EXPECT_FALSE(errors_.clear(0x3220));
  EXPECT_EQ(error_register(), 0x11);
  EXPECT_FALSE(errors_.stands(0x3220));
  EXPECT_TRUE(errors_.clear(0x8130));  // the last one
  EXPECT_EQ(error_register(), 0);
  EXPECT_FALSE(errors_.clear(0x8130));
}

TEST_F(ErrorRecordTest, WhatStandsIsNotRaisedAgain) {
  EXPECT_TRUE(errors_.raise(0x2310));
  EXPECT_FALSE(errors_.raise(0x2310));
  EXPECT_EQ(history(0), 1);
  errors_.clear(0x2310);
  EXPECT_TRUE(errors_.raise(0x2310));
  EXPECT_EQ(history(0), 2);
  EXPECT_FALSE(errors_.raise(0));
}

/// An EPOS2 keeps five.
TEST_F(ErrorRecordTest, HistoryIsNewestFirstAndLimited) {
  for (int i = 0; i < 7; ++i) errors_.raise(static_cast<std::uint16_t>(0x3200 + i));
  EXPECT_EQ(history(0), 5);
  EXPECT_EQ(history(1), 0x3206);
  EXPECT_EQ(history(5), 0x3202);
  errors_.clear_history();
  EXPECT_EQ(history(0), 0);
  EXPECT_EQ(history(1), 0);
  EXPECT_EQ(error_register(), 0x05);  // what stands still stands
}

TEST_F(ErrorRecordTest, MoreThanItKeepsForgetTheOldest) {
  for (std::size_t i = 0; i <= ErrorRecord::kStanding; ++i)
    errors_.raise(static_cast<std::uint16_t>(0x3200 + i));
  EXPECT_FALSE(errors_.stands(0x3200));
  EXPECT_TRUE(errors_.stands(0x3201));
  EXPECT_TRUE(errors_.clear_all());
  EXPECT_FALSE(errors_.clear_all());
}

TEST_F(ErrorRecordTest, RestartForgetsWhatStood) {
  errors_.raise(0x2310);
  dictionary_.restart();
  errors_.restart();
  EXPECT_FALSE(errors_.stands(0x2310));
  EXPECT_EQ(history(0), 0);
  EXPECT_EQ(error_register(), 0);
}

}  // namespace
}  // namespace sprung::sim
