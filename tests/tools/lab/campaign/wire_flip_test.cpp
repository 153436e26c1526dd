#include "tools/lab/campaign/wire_flip.h"

#include <gtest/gtest.h>

namespace sprung::campaign {
namespace {

/// Whichever bit it is, the message's MAC or its layout tells.
template <class Signal>
void expect_never_to_arrive(const Signal& message) {
  for (std::uint64_t bit = 0; bit < 3000; bit += 7) {
    Signal copy = message;
    ASSERT_FALSE(arrives_flipped(copy, bit)) << bit;
  }
}

TEST(WireFlip, NoMessageWithABitTurnedOverIsBelieved) {
  expect_never_to_arrive(DriveState(2));
  expect_never_to_arrive(JointState(2, 1));
  expect_never_to_arrive(LegCommand(1));
  expect_never_to_arrive(DriveCommand(2));
  expect_never_to_arrive(Imu());
}

}  // namespace
}  // namespace sprung::campaign
