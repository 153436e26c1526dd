// The simulated EPOS2 in its profile and velocity modes, seen through its objects by SDO.
#include "drivers/profiles/epos2/epos2_motion_device.h"

#include <algorithm>
#include <cmath>

#include "tests/simulation/node/drive_bench.h"

namespace sprung::sim {
namespace {

constexpr std::uint16_t kEpos2Demand = 0x6062;
constexpr double kEpos2MotionCountsPerRad = 16384 * 50 / (2 * M_PI);

class Epos2ProfileModes : public ::testing::Test {
 protected:
  /// The shaft is where the drive wants it.
  void follow(double time_s) {
    const int ticks = static_cast<int>(std::lround(time_s * 4000));
    for (int i = 0; i < ticks; ++i) {
      bench_.shaft_rad = bench_.read_i32(kEpos2Demand) / kEpos2MotionCountsPerRad + zero_rad_;
      bench_.run(0.00025);
    }
  }
  void start(int mode) {
    zero_rad_ = bench_.shaft_rad - bench_.read_i32(canopen::kPositionActual) / kEpos2MotionCountsPerRad;
    bench_.start(mode);
  }
  bool bit(int n) { return (bench_.status() >> n & 1) != 0; }

  DriveBench bench_;
  double zero_rad_ = 0.0;
};

TEST_F(Epos2ProfileModes, PositionIsAcknowledgedReachedAndTakesTheTimeOfItsProfile) {
  start(epos2::kModeProfilePosition);
  EXPECT_EQ(bench_.read_i16(canopen::kModeDisplay) & 0xFF, 1);
  const int from = bench_.read_i32(kEpos2Demand);
  // 1000 rpm after 0.1 s, given up in 0.1 s: a quarter of a second for 2.5 motor turns.
  bench_.write(canopen::kTargetPosition, from + 40960, 4);
  bench_.control({0x0F, 0x1F});
  EXPECT_TRUE(bit(12)) << "the set-point is taken";
  EXPECT_FALSE(bit(10));
  follow(0.12);
  EXPECT_NEAR(bench_.read_i32(kEpos2Demand), from + 16384 * (0.05 + 0.02) * 1000 / 60, 300);
  bench_.control({0x0F});
  EXPECT_FALSE(bit(12));
  follow(0.4);
  EXPECT_EQ(bench_.read_i32(kEpos2Demand), from + 40960);
  EXPECT_TRUE(bit(10));
  EXPECT_EQ(bench_.status() & 0x6F, 0x27);
}

TEST_F(Epos2ProfileModes, SecondTargetWaitsUnlessItIsToActAtOnceAndRelativeOnesAddUp) {
  start(epos2::kModeProfilePosition);
  const int from = bench_.read_i32(kEpos2Demand);
  bench_.write(canopen::kTargetPosition, 10000, 4);
  bench_.control({0x0F, 0x5F, 0x0F, 0x5F, 0x0F});  // twice, relative
  follow(1.0);
  EXPECT_EQ(bench_.read_i32(kEpos2Demand), from + 20000);
  bench_.write(canopen::kTargetPosition, from + 60000, 4);
  bench_.control({0x0F, 0x1F, 0x0F});
  follow(0.05);
  bench_.write(canopen::kTargetPosition, from, 4);
  bench_.control({0x0F, 0x3F, 0x0F});  // at once: it turns round on its way
  int furthest = 0;
  for (int i = 0; i < 50; ++i) {
    follow(0.02);
    furthest = std::max(furthest, bench_.read_i32(kEpos2Demand));
  }
  EXPECT_EQ(bench_.read_i32(kEpos2Demand), from);
  EXPECT_LT(furthest, from + 50000);
}

TEST_F(Epos2ProfileModes, VelocityIsTakenUpWithItsAcceleration) {
  start(epos2::kModeProfileVelocity);
  const int from = bench_.read_i32(kEpos2Demand);
  EXPECT_TRUE(bit(12)) << "it stands still";
  bench_.write(0x60FF, 600, 4);  // rpm, at 10000 rpm/s after 0.06 s
  follow(0.56);
  EXPECT_NEAR(bench_.read_i32(kEpos2Demand) - from, 16384 * 10 * 0.53, 200);
  EXPECT_FALSE(bit(12));
}

TEST_F(Epos2ProfileModes, DirectVelocityModeTurnsAtOnceWithinTheDrivesLimit) {
  bench_.write(0x607F, 300, 4);
  start(epos2::kModeVelocity);
  const int from = bench_.read_i32(kEpos2Demand);
  bench_.write(0x206B, -600, 4);
  follow(0.5);
  EXPECT_NEAR(bench_.read_i32(kEpos2Demand) - from, -16384 * 5 * 0.5, 200);
}

TEST_F(Epos2ProfileModes, MotorPushesTowardTheReference) {
  start(epos2::kModeProfilePosition);
  bench_.write(canopen::kTargetPosition, bench_.read_i32(kEpos2Demand) + 1500, 4);
  bench_.control({0x0F, 0x1F});
  bench_.run(0.1);  // the shaft is held
  EXPECT_GT(bench_.drive->motor_torque_Nm(), 0.0);
}

TEST_F(Epos2ProfileModes, HeldShaftIsAFollowingError) {
  start(epos2::kModeProfilePosition);
  bench_.write(canopen::kTargetPosition, bench_.read_i32(kEpos2Demand) + 20000, 4);
  bench_.control({0x0F, 0x1F});
  bench_.run(0.5);
  EXPECT_EQ(bench_.emergencies, std::vector<int>{0x8611});
}

TEST(Epos2Modes, ThoseThatAreNotSimulatedAndThoseThatNobodyHasAreRefused) {
  DriveBench bench;
  for (const int mode : {6, 7, -4, -5, -6, 2, 8, 10, 99, -128, 127, 0})
    EXPECT_EQ(bench.try_write(canopen::kMode, mode, 1), canopen::kAbortRange) << mode;
  for (const int mode : {1, 3, -1, -2, -3}) EXPECT_EQ(bench.try_write(canopen::kMode, mode, 1), 0U) << mode;
}

/// Bit n - 1 is mode n.
TEST(Epos2Modes, ThoseThatItOffersAreThoseThatItTakes) {
  DriveBench bench;
  const std::uint32_t offered = bench.read(canopen::kSupportedModes);
  for (int mode = 1; mode <= 32; ++mode) {
    const bool taken = bench.try_write(canopen::kMode, mode, 1) == 0;
    EXPECT_EQ(taken, (offered >> (mode - 1) & 1U) != 0) << mode;
  }
}

}  // namespace
}  // namespace sprung::sim
