#include "drivers/can/socketcan_bus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/can/can_errors.h"

namespace sprung {
namespace {

// The machine that builds may have no CAN in its kernel; tests/vm runs real frames. Both refusals say what to
// do.
TEST(SocketCanBus, MissingInterfaceGivesAnErrorThatSaysWhatToDo) {
  try {
    SocketCanBus bus("nosuchcan9");
    FAIL() << "opened an interface that does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("socketcan:nosuchcan9"));
    EXPECT_THAT(error.what(),
                testing::AnyOf(testing::HasSubstr("modprobe can-raw"), testing::HasSubstr("ip link")));
  }
}

TEST(CanErrors, BusOffPassiveAndTimeOutMeanTheBusIsLost) {
  EXPECT_TRUE(tells_bus_lost(bus_lost_frame()));
  CanFrame frame = bus_lost_frame();
  frame.id = kCanErrorTxTimeout;
  EXPECT_TRUE(tells_bus_lost(frame));
  frame.id = kCanErrorController;
  EXPECT_FALSE(tells_bus_lost(frame));
  frame.data[1] = 0x20;
  EXPECT_TRUE(tells_bus_lost(frame));
  frame.error = false;
  EXPECT_FALSE(tells_bus_lost(frame)) << "a data frame with the same id";
}

TEST(CanErrors, FullQueueLosesTheBusButIsToldApart) {
  EXPECT_TRUE(tells_queue_full(queue_full_frame()));
  EXPECT_TRUE(tells_bus_lost(queue_full_frame()));
  EXPECT_FALSE(tells_queue_full(bus_lost_frame()));
  CanFrame data = queue_full_frame();
  data.error = false;
  EXPECT_FALSE(tells_queue_full(data));
}

TEST(CanErrors, LinkThatIsDownLosesTheBusAndIsNoOtherError) {
  EXPECT_TRUE(tells_link_down(link_down_frame()));
  EXPECT_TRUE(tells_bus_lost(link_down_frame()));
  EXPECT_FALSE(tells_queue_full(link_down_frame()));
  CanFrame time_out = bus_lost_frame();
  time_out.id = kCanErrorTxTimeout;
  for (const CanFrame& other : {bus_lost_frame(), queue_full_frame(), time_out})
    EXPECT_FALSE(tells_link_down(other));
  CanFrame data = link_down_frame();
  data.error = false;
  EXPECT_FALSE(tells_link_down(data));
}

TEST(CanErrors, RestartIsToldByItsOwnClass) {
  CanFrame frame = bus_lost_frame();
  EXPECT_FALSE(tells_bus_restarted(frame));
  frame.id = kCanErrorRestarted;
  EXPECT_TRUE(tells_bus_restarted(frame));
  EXPECT_FALSE(tells_bus_lost(frame));
}

}  // namespace
}  // namespace sprung
