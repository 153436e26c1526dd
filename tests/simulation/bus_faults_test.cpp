#include "simulation/bus_faults.h"

#include <gtest/gtest.h>

#include "drivers/can/can_errors.h"
#include "drivers/can/lockstep_burst.h"

namespace sprung::sim {
namespace {

TEST(BusFaults, BusOffIsToldOnceAndItsEndAsARestart) {
  BusFaults faults(2);
  FrameBatch out;
  faults.set(1, FaultKind::kBusOff, true);
  faults.sync(1);
  faults.report(out);
  ASSERT_EQ(out.size(), 1);
  EXPECT_EQ(out[0].bus, 1);
  EXPECT_TRUE(tells_bus_lost(out[0].frame));
  out.clear();
  faults.set(1, FaultKind::kBusOff, false);
  faults.report(out);
  ASSERT_EQ(out.size(), 1);
  EXPECT_TRUE(tells_bus_restarted(out[0].frame));
  EXPECT_FALSE(tells_bus_lost(out[0].frame));
  faults.report(out);
  EXPECT_EQ(out.size(), 1);
}

TEST(BusFaults, ErrorPassiveLosesTheBusAndItsEndDoesNot) {
  BusFaults faults(1);
  FrameBatch out;
  faults.set(0, FaultKind::kErrorPassive, true);
  faults.set(0, FaultKind::kErrorPassive, false);
  faults.report(out);
  ASSERT_EQ(out.size(), 2);
  EXPECT_TRUE(tells_bus_lost(out[0].frame));
  EXPECT_TRUE(out[1].frame.error);
  EXPECT_FALSE(tells_bus_lost(out[1].frame));
}

TEST(BusFaults, FullQueueAndDeadLinkLoseTheMastersFramesAndAreToldAtEachSync) {
  for (const FaultKind kind : {FaultKind::kQueueFull, FaultKind::kLinkDown}) {
    BusFaults faults(2);
    FrameBatch out;
    faults.set(0, kind, true);
    EXPECT_FALSE(faults.delivers(0));
    EXPECT_TRUE(faults.delivers(1));
    for (int i = 0; i < 3; ++i) faults.sync(0);
    faults.sync(1);
    faults.report(out);
    ASSERT_EQ(out.size(), 3);
    EXPECT_EQ(tells_queue_full(out[0].frame), kind == FaultKind::kQueueFull);
    EXPECT_EQ(tells_link_down(out[0].frame), kind == FaultKind::kLinkDown);
    EXPECT_TRUE(tells_bus_lost(out[0].frame));
    faults.set(0, kind, false);
    EXPECT_TRUE(faults.delivers(0));
  }
}

TEST(BusFaults, NoErrorFrameIsTheEndOfTickMark) {
  BusFaults faults(1);
  FrameBatch out;
  for (const FaultKind kind :
       {FaultKind::kBusOff, FaultKind::kErrorPassive, FaultKind::kQueueFull, FaultKind::kLinkDown}) {
    for (const bool on : {true, false}) {
      faults.set(0, kind, on);
      faults.sync(0);
    }
  }
  faults.report(out);
  EXPECT_GE(out.size(), 4);
  for (const BusFrame& entry : out) EXPECT_FALSE(is_end_of_tick_mark(entry.frame));
}

TEST(BusFaults, BusThatDoesNotExistIsIgnoredAndTooManyFramesAreLost) {
  BusFaults faults(1);
  FrameBatch out;
  faults.set(-1, FaultKind::kBusOff, true);
  faults.set(1, FaultKind::kBusOff, true);
  faults.report(out);
  EXPECT_EQ(out.size(), 0);
  for (int i = 0; i < 100; ++i) faults.set(0, FaultKind::kBusOff, true);
  faults.report(out);
  EXPECT_EQ(out.size(), 64);
}

}  // namespace
}  // namespace sprung::sim
