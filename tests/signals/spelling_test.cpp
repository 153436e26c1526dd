#include "signals/spelling.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(Spelling, CountsEveryKindOfSlipOnce) {
  EXPECT_EQ(typing_slips("jump", "jump"), 0u);
  EXPECT_EQ(typing_slips("jmp", "jump"), 1u);    // left out
  EXPECT_EQ(typing_slips("jjump", "jump"), 1u);  // added
  EXPECT_EQ(typing_slips("jumo", "jump"), 1u);   // changed
  EXPECT_EQ(typing_slips("jupm", "jump"), 1u);   // swapped
  EXPECT_EQ(typing_slips("", "jump"), 4u);
  EXPECT_EQ(typing_slips("stand", "jump"), 5u);
}

TEST(Spelling, TakesTheNearestAndOfSeveralTheFirst) {
  EXPECT_EQ(nearest_word("stnd", {"sit", "stand", "status"}), "stand");
  EXPECT_EQ(nearest_word("stat", {"start", "state"}), "start");
}

TEST(Spelling, APieceThatWasLeftOutIsOneSlip) {
  EXPECT_EQ(nearest_word("gear_torque_Nm", {"external_torque_Nm", "gear_output_torque_Nm"}),
            "gear_output_torque_Nm");
  EXPECT_EQ(nearest_word("sta", {"sit", "status"}), "status");
}

TEST(Spelling, WhatIsFarAwayIsNotMeant) {
  EXPECT_EQ(nearest_word("robots", {"sit", "stand", "up"}), "");
  EXPECT_EQ(nearest_word("x", {"up", "sit"}), "");
  EXPECT_EQ(nearest_word("-x", {"-h"}), "");
  EXPECT_EQ(nearest_word("", {"up"}), "");
  EXPECT_EQ(nearest_word("jump", {}), "");
}

TEST(Spelling, AsksOnlyWhereSomethingIsNear) {
  EXPECT_EQ(did_you_mean("jmp", {"jump"}), "; did you mean 'jump'?");
  EXPECT_EQ(did_you_mean("walk", {"jump"}), "");
}

}  // namespace
}  // namespace sprung
