#include "simulation/plant/drive_train.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "robots/robot_loader.h"
#include "tests/support/allocation_count.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

constexpr double kTwoPi = 2 * M_PI;

/// Four buses with three drives and an encoder card each.
class PegasusTrain : public testing::Test {
 protected:
  PegasusTrain() {
    for (SimDriveConfig& drive : config_.drives) drive.kinematic_error = {};
    for (SimCardConfig& card : config_.cards) card.noise_rad = 0.0;
  }
  static RobotConfig pegasus() { return load_robot(test::source_dir() + "/robots/pegasus"); }
  void start(DriveTrain& train) {
    train.open(&out_);
    for (time_us_ = 250; time_us_ < 5000; time_us_ += 250) train.step_drives(time_us_);
    to_all(train, canopen::nmt_frame(canopen::NmtCommand::kStart, 0));
  }
  void to_all(DriveTrain& train, const CanFrame& frame) {
    for (int bus = 0; bus < 4; ++bus) train.receive(bus, frame, time_us_);
  }
  /// Link angle of each actuator as its card says, after direction and offset, within half a turn.
  std::map<std::size_t, double> links(DriveTrain& train, std::int64_t cycle) {
    out_.clear();
    for (int bus = 0; bus < 4; ++bus) {
      train.sample(bus, 0.0, cycle);
      train.receive(bus, canopen::sync_frame(), time_us_);
    }
    std::map<std::size_t, double> links;
    for (const BusFrame& entry : out_) {
      for (std::size_t i = 0; i < robot_.actuators.size(); ++i) note(entry, i, links);
    }
    return links;
  }
  void note(const BusFrame& entry, std::size_t actuator, std::map<std::size_t, double>& links) const {
    const LinkEncoderConfig& link = robot_.actuators[actuator].link_encoder;
    const EncoderCardConfig& card = robot_.encoder_cards[link.card];
    if (entry.bus != card.bus || entry.frame.id != canopen::tpdo_id(0, card.node)) return;
    std::uint64_t word = 0;
    for (int byte = 7; byte >= 0; --byte) word = word << 8 | entry.frame.data[byte];
    const auto counts = encoder_card::unpack(word).counts[link.channel];
    const double angle_rad = link.direction * counts * kTwoPi / link.counts_per_turn + link.offset_rad;
    links[actuator] = std::remainder(angle_rad, kTwoPi);
  }
  double true_rad(DriveTrain& train, std::size_t joint) const { return train.plant().position_rad(joint); }

  RobotConfig robot_ = pegasus();
  SimConfig config_ = load_sim_config(robot_, {});
  FrameBatch out_;
  std::int64_t time_us_ = 0;
};

TEST_F(PegasusTrain, IsOperationalWhenDrivesAndCardsAre) {
  DriveTrain train(robot_, config_, 1);
  train.open(&out_);
  for (time_us_ = 250; time_us_ < 5000; time_us_ += 250) train.step_drives(time_us_);
  for (const int node : {1, 2, 3}) to_all(train, canopen::nmt_frame(canopen::NmtCommand::kStart, node));
  EXPECT_FALSE(train.all_operational());
  to_all(train, canopen::nmt_frame(canopen::NmtCommand::kStart, 4));
  EXPECT_TRUE(train.all_operational());
}

TEST_F(PegasusTrain, CardsShowTheLinksWithinACount) {
  DriveTrain train(robot_, config_, 1);
  start(train);
  const std::map<std::size_t, double> seen = links(train, 0);
  ASSERT_EQ(seen.size(), robot_.actuators.size());
  for (const auto& [actuator, angle_rad] : seen) {
    EXPECT_NEAR(std::remainder(angle_rad - true_rad(train, actuator), kTwoPi), 0.0, kTwoPi / (1 << 20))
        << actuator;
  }
}

TEST_F(PegasusTrain, KinematicErrorIsSeenByTheLinkOnly) {
  config_.drives[4].kinematic_error = {0.001, 2.0, M_PI / 2};
  config_.drives[4].absolute_encoder = true;
  DriveTrain train(robot_, config_, 1);
  start(train);
  const ActuatorConfig& actuator = robot_.actuators[4];
  const double motor_rad = (true_rad(train, 4) - actuator.offset_rad) * actuator.direction *
                           actuator.gear_ratio;
  const double expected_rad = 0.001 * std::cos(2.0 * motor_rad);
  EXPECT_NEAR(std::remainder(links(train, 0)[4] - true_rad(train, 4), kTwoPi), expected_rad,
              kTwoPi / (1 << 20));
}

TEST_F(PegasusTrain, ZeroErrorShowsInTheLinkWithItsSign) {
  for (SimDriveConfig& drive : config_.drives) drive.kinematic_error = {};
  config_.drives[4].mounting.zero_error_rad = 0.004;
  DriveTrain train(robot_, config_, 1);
  start(train);
  const std::map<std::size_t, double> seen = links(train, 0);
  EXPECT_NEAR(std::remainder(seen.at(4) - true_rad(train, 4), kTwoPi), 0.004, kTwoPi / (1 << 20));
  EXPECT_NEAR(std::remainder(seen.at(5) - true_rad(train, 5), kTwoPi), 0.0, kTwoPi / (1 << 20));
}

TEST_F(PegasusTrain, LinkNoiseHasItsRmsAndFollowsSeedAndCycle) {
  for (SimCardConfig& card : config_.cards) card.noise_rad = 0.001;
  DriveTrain train(robot_, config_, 1);
  DriveTrain same(robot_, config_, 1);
  start(train);
  start(same);
  same.open(&out_);
  double square = 0.0;
  constexpr int kCycles = 400;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    train.open(&out_);
    const double seen_rad = links(train, cycle)[7];
    square += std::pow(std::remainder(seen_rad - true_rad(train, 7), kTwoPi), 2);
    same.open(&out_);
    EXPECT_EQ(links(same, cycle)[7], seen_rad);
  }
  EXPECT_NEAR(std::sqrt(square / kCycles), 0.001, 0.0001);
}

TEST_F(PegasusTrain, FaultOfABusHitsItsDrivesAndItsCard) {
  DriveTrain train(robot_, config_, 1);
  start(train);
  train.set_bus_fault(1, FaultKind::kLinkDown, 0.0, true);
  const std::map<std::size_t, double> seen = links(train, 0);
  EXPECT_EQ(seen.size(), robot_.actuators.size() - 3);
  for (std::size_t i = 0; i < robot_.actuators.size(); ++i)
    EXPECT_EQ(train.drive(static_cast<int>(i))->outbox().cut(), robot_.actuators[i].bus == 1) << i;
  train.set_bus_fault(1, FaultKind::kLinkDown, 0.0, false);
  EXPECT_EQ(links(train, 1).size(), robot_.actuators.size());
  train.set_fault(99, FaultKind::kLinkDown, 0.0, true);  // there is no such actuator
  EXPECT_EQ(links(train, 2).size(), robot_.actuators.size());
}

/// Draws nothing until a motor gets current; then all drives have less.
TEST_F(PegasusTrain, RealWindingsShareASupplyThatSags) {
  config_.real_windings = true;
  DriveTrain train(robot_, config_, 1);
  start(train);
  ASSERT_TRUE(train.supply().has_value());
  EXPECT_NEAR(train.supply()->voltage_V(), config_.supply->voltage_V, 1e-9);
  const auto to = [&](std::uint16_t index, std::int64_t value, int size) {
    to_all(train, canopen::sdo_write_request(1, {index, 0}, static_cast<std::uint32_t>(value), size));
    for (int i = 0; i < 4; ++i) train.step_drives(time_us_ += 250);
  };
  for (const int word : {0x00, 0x80}) to(canopen::kControlWord, word, 2);
  to(canopen::kMode, -3, 1);
  for (const int word : {0x06, 0x07, 0x0F}) to(canopen::kControlWord, word, 2);
  for (int i = 0; i < 200; ++i) train.step_drives(time_us_ += 250);
  to(0x2030, 3000, 2);
  for (int i = 0; i < 200; ++i) train.step_drives(time_us_ += 250);
  const double current_A = train.drive(0)->motor_torque_Nm() / (50.0 * 0.217);
  ASSERT_NEAR(current_A, 3.0, 0.01);
  const double drawn_W = 4 * 2.3 * current_A * current_A;  // one drive a bus, held
  const double half_V = 0.5 * config_.supply->voltage_V;
  const double sagged_V = half_V + std::sqrt(half_V * half_V - config_.supply->resistance_ohm * drawn_W);
  EXPECT_NEAR(train.supply()->voltage_V(), sagged_V, 1e-3);
}

TEST_F(PegasusTrain, IdealWindingsNeedNoSupply) {
  DriveTrain train(robot_, config_, 1);
  EXPECT_FALSE(train.supply().has_value());
}

/// operator new alone is counted: MuJoCo has its own.
TEST_F(PegasusTrain, AllocatesNothingWhileItRunsAndFaultsComeAndGo) {
  DriveTrain train(robot_, config_, 1);
  start(train);
  const std::int64_t before = test::allocation_count();
  for (int i = 0; i < 200; ++i) {
    const auto kind = static_cast<FaultKind>(1 + i % 19);
    train.set_fault(i % 12, kind, 0.5, i % 38 < 19);
    train.set_bus_fault(i % 4, kind, 0.5, i % 38 < 19);
    train.step_drives(time_us_ += 250);
    train.step_plant();
    out_.clear();
    for (int bus = 0; bus < 4; ++bus) {
      train.sample(bus, 0.0, i);
      train.receive(bus, canopen::sync_frame(), time_us_);
    }
  }
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace sprung::sim
