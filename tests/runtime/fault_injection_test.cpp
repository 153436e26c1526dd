#include "runtime/fault_injection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung {
namespace {

TEST(FaultInjection, WithoutTextsNothingHappens) {
  FaultInjection faults;
  EXPECT_EQ(faults.on_receive("A", 0), LinkFault::kNone);
  EXPECT_EQ(faults.on_publish("A", 0), LinkFault::kNone);
}

TEST(FaultInjection, ActsOnTheFirstOccurrenceOnly) {
  FaultInjection faults({"drop-rx:LEG_COMMAND:100"});
  EXPECT_EQ(faults.on_receive("LEG_COMMAND", 99), LinkFault::kNone);
  EXPECT_EQ(faults.on_receive("JOINT_STATE", 100), LinkFault::kNone);
  EXPECT_EQ(faults.on_receive("LEG_COMMAND", 100), LinkFault::kDropReceived);
  EXPECT_EQ(faults.on_receive("LEG_COMMAND", 100), LinkFault::kNone);
}

TEST(FaultInjection, SendingAndReceivingAreApart) {
  FaultInjection faults({"drop-tx:A:1", "repeat-tx:A:2", "drop-rx:A:3"});
  EXPECT_EQ(faults.on_receive("A", 1), LinkFault::kNone);
  EXPECT_EQ(faults.on_publish("A", 3), LinkFault::kNone);
  EXPECT_EQ(faults.on_publish("A", 1), LinkFault::kDropSent);
  EXPECT_EQ(faults.on_publish("A", 2), LinkFault::kRepeatSent);
}

TEST(FaultInjection, SameFaultTwiceActsTwice) {
  FaultInjection faults({"drop-tx:A:1", "drop-tx:A:1"});
  EXPECT_EQ(faults.on_publish("A", 1), LinkFault::kDropSent);
  EXPECT_EQ(faults.on_publish("A", 1), LinkFault::kDropSent);
  EXPECT_EQ(faults.on_publish("A", 1), LinkFault::kNone);
}

TEST(FaultInjection, RefusesWhatItDoesNotUnderstand) {
  for (const char* text :
       {"", "drop", "drop-rx:A", "drop-rx::1", "drop-up:A:1", "drop-rx:A:", "drop-rx:A:1x", "drop-rx:A:x"}) {
    try {
      const FaultInjection faults({text});
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("repeat-tx:CHANNEL:SEQ"));
    }
  }
}

}  // namespace
}  // namespace sprung
