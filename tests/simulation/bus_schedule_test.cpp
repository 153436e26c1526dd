#include "simulation/bus_schedule.h"

#include <gtest/gtest.h>

namespace sprung::sim {
namespace {

BusFrame on_bus(int bus, int length) { return {bus, {0x201, static_cast<std::uint8_t>(length), {}, false}}; }

TEST(BusSchedule, FrameTimesAreTheWorstCaseAtOneMegabit) {
  EXPECT_EQ(frame_us({0x80, 0, {}, false}), 55);
  EXPECT_EQ(frame_us({0x181, 8, {}, false}), 135);
}

TEST(BusSchedule, SetPointsFollowAnswersAndComputeTimeOnEachBus) {
  BusSchedule schedule(2);
  schedule.start_answers(0);
  schedule.add_answer(on_bus(0, 8));
  schedule.add_answer(on_bus(0, 8));
  schedule.start_burst(5000, 300);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 7), 6000), 5000 + 55 + 270 + 300 + 125);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 7), 6000), 5000 + 55 + 270 + 300 + 250);
  EXPECT_EQ(schedule.acts_us(on_bus(1, 7), 6000), 5000 + 55 + 300 + 125);  // nobody answered there
}

TEST(BusSchedule, NothingActsAfterTheNextSync) {
  BusSchedule schedule(1);
  schedule.start_burst(5000, 900);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 8), 6000), 6000);
}

/// And what comes after them waits until the bus is free again.
TEST(BusSchedule, LateFramesActAfterTheNextSyncWhereTheyMay) {
  BusSchedule schedule(1);
  schedule.start_burst(5000, 900, true);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 8), 6000), 5000 + 55 + 900 + 135);
  schedule.start_answers(0);
  schedule.start_burst(6000, 0, true);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 8), 7000), 6090 + 135);
}

TEST(BusSchedule, AnswersCountSinceTheLastSync) {
  BusSchedule schedule(1);
  schedule.add_answer(on_bus(0, 8));
  schedule.start_answers(0);
  schedule.start_burst(0, 0);
  EXPECT_EQ(schedule.acts_us(on_bus(0, 0), 1000), 55 + 55);
}

}  // namespace
}  // namespace sprung::sim
