#include "simulation/sim_core.h"

#include <cmath>

#include "tests/simulation/node/test_master.h"
#include "tests/support/allocation_count.h"

namespace sprung::sim {
namespace {

constexpr double kCorePerMille_Nm = 1e-3 * 0.308 * 100.0;  // rated motor torque 7 A * 0.044 Nm/A, ratio 100
constexpr double kCoreCountsPerRad = 131072.0 * 100.0 / 6.283185307179586;

/// Folds the unpowered leg, which its friction holds up otherwise.
void press(SimMaster& master) {
  SimControl push;
  push.wrench = {0, 0, -200, 0, 0, 0};
  push.duration_s = 1.0;
  master.sim.control(push);
}

TEST(SimCore, BootsUpOnceAndStaysPreOperationalUntilStarted) {
  SimMaster master;
  master.ticks(5);
  EXPECT_EQ(master.drives[1].nmt_states, std::vector<int>{0x00});
  EXPECT_EQ(master.drives[2].nmt_states, std::vector<int>{0x00});
  EXPECT_EQ(master.drives[1].tpdo1_count, 0);
  EXPECT_EQ(master.sim.cycle(), -1);
}

TEST(SimCore, PlantIsHeldUntilEveryDriveIsOperational) {
  SimMaster master;
  master.ticks(2);
  for (const int node : {1, 2}) master.configure(node);
  master.queue(canopen::nmt_frame(canopen::NmtCommand::kStart, 1));
  master.ticks(50);
  EXPECT_EQ(master.sim.cycle(), -1);
  const std::int32_t held = master.drives[1].position_counts;
  EXPECT_NEAR(held / kCoreCountsPerRad, 3.2733, 1e-6);
  master.queue(canopen::nmt_frame(canopen::NmtCommand::kStart, 2));
  master.tick();
  EXPECT_EQ(master.sim.cycle(), 0);
  EXPECT_EQ(master.drives[1].position_counts, held);
  master.ticks(100);
  EXPECT_EQ(master.sim.cycle(), 100);
  EXPECT_NE(master.drives[1].position_counts, held);  // the leg settles into the ground
  EXPECT_FALSE(master.sim.failed()) << master.sim.failure();
}

TEST(SimCore, SyncAnswerHoldsPositionTorqueAndStatus) {
  SimMaster master;
  master.boot();
  const SimTruth& truth = master.sim.truth();
  for (const int node : {1, 2}) {
    const DriveAnswer& drive = master.drives[node];
    const double true_rad = truth.joints[node - 1].true_position_rad;
    EXPECT_NEAR(drive.position_counts, true_rad * kCoreCountsPerRad, 1.0);
    EXPECT_LT(std::abs(drive.torque_per_mille) * kCorePerMille_Nm, 4 * 0.5);
    EXPECT_EQ(drive.status_word & 0x26F, 0x240);  // switch-on disabled, remote
  }
}

TEST(SimCore, PositionLoopHoldsTheLegUnderItsWeight) {
  SimMaster master;
  master.boot();
  const SetPoint hip{0, master.drives[1].position_counts, 8};
  const SetPoint knee{0, master.drives[2].position_counts, 8};
  master.drive(1, {{1, hip}, {2, knee}});
  for (const int word : {0x06, 0x07, 0x0F}) master.control_word(word);
  const std::int32_t start = master.drives[2].position_counts;
  master.drive(2000, {{1, hip}, {2, knee}});
  EXPECT_TRUE(master.powered(1) && master.powered(2));
  EXPECT_NEAR(master.drives[2].position_counts, start, 0.05 * kCoreCountsPerRad);
  const SimTruth& truth = master.sim.truth();
  EXPECT_NEAR(truth.legs[0].true_contact_force_N[2], 5.23 * 9.81, 0.5);
  EXPECT_NEAR(truth.base_velocity_m_s[2], 0.0, 1e-3);
}

TEST(SimCore, TorqueStepRisesAsA94HertzLag) {
  SimOptions options;
  options.plant = {{"noise_scale", 0.0}};
  SimMaster master(options);
  master.boot();
  master.enable();
  master.drive(5, {{1, {0, 0, 10}}, {2, {0, 0, 10}}});
  constexpr int kStep = 500;
  for (int cycle = 1; cycle <= 8; ++cycle) {
    master.drive(1, {{1, {0, 0, 10}}, {2, {kStep, 0, 10}}});
    // The set-point is on the bus 0.9 ms after its SYNC: the loop sees it at the next tick of 4 kHz.
    const double since_s = 1e-3 * (cycle - 1);
    const double expected = kStep * (1.0 - std::exp(-2 * M_PI * 94.0 * since_s));
    EXPECT_NEAR(master.drives[2].torque_per_mille, expected, 0.005 * kStep) << cycle;
  }
}

TEST(SimCore, ModeSwitchIsConfirmedByTpdo2) {
  SimMaster master;
  master.boot();
  master.enable();
  master.drive(3, {{1, {0, 0, 10}}, {2, {0, 0, 10}}});
  EXPECT_EQ(master.drives[2].mode, 10);
  const std::int32_t here = master.drives[2].position_counts;
  master.drive(3, {{1, {0, 0, 10}}, {2, {0, here, 8}}});
  EXPECT_EQ(master.drives[2].mode, 8);
  EXPECT_EQ(master.drives[1].mode, 10);
}

TEST(SimCore, ControlActsAtItsCycleAndForItsTime) {
  SimMaster master;
  master.boot();
  SimControl push;
  push.apply_at_seq = 20;
  push.wrench = {0, 0, 300, 0, 0, 0};
  push.duration_s = 0.01;
  master.sim.control(push);
  while (master.sim.cycle() < 20) master.tick();
  const double before = master.sim.truth().base_velocity_m_s[2];
  master.ticks(10);
  const double pushed = master.sim.truth().base_velocity_m_s[2];
  EXPECT_GT(pushed, before + 0.2);
  master.ticks(10);
  EXPECT_LT(master.sim.truth().base_velocity_m_s[2], pushed);
}

TEST(SimCore, SuspendedRobotHangsWhereItIsPutAndFallsWhenLetGo) {
  SimMaster master;
  master.boot();
  master.control(SimControlKind::kSuspend, -1, 0.8);
  master.ticks(300);
  EXPECT_NEAR(master.sim.truth().base_in_world_m[2], 0.8, 1e-5);
  EXPECT_EQ(master.sim.truth().legs[0].true_contact_force_N[2], 0.0);
  master.control(SimControlKind::kSuspend, -1, 0.0);
  master.ticks(101);
  EXPECT_NEAR(master.sim.truth().base_in_world_m[2], 0.8 - 0.5 * 9.81 * 0.01, 0.005);
}

TEST(SimCore, ResetBringsTheInitialPoseBack) {
  SimMaster master;
  master.boot();
  press(master);
  master.ticks(100);
  ASSERT_GT(master.drives[2].position_counts, (2.3595 + 0.05) * kCoreCountsPerRad);
  master.control(SimControlKind::kReset, -1, 0.0);
  master.tick();
  EXPECT_EQ(master.drives[2].position_counts,
            static_cast<std::int32_t>(std::floor(2.3595 * kCoreCountsPerRad)));
}

TEST(SimCore, TorqueConstantOfThePlantScalesTrueTorqueNotTheShownOne) {
  SimOptions strong;
  strong.plant = {{"kt_scale", 1.2}, {"noise_scale", 0.0}};
  SimMaster master(strong);
  master.boot();
  master.enable();
  master.drive(30, {{1, {0, 0, 10}}, {2, {-100, 0, 10}}});
  EXPECT_NEAR(master.drives[2].torque_per_mille, -100, 1);
  EXPECT_NEAR(master.sim.truth().joints[1].true_motor_torque_Nm, -1.2 * 100 * kCorePerMille_Nm, 1e-3);
}

TEST(SimCore, UnknownPlantKeyIsRefusedWithTheKnownOnes) {
  SimOptions options;
  options.plant = {{"gravity", 1.6}};
  try {
    SimCore sim(single_leg(), options);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("friction_scale"), std::string::npos) << error.what();
  }
}

/// Real time: SYNC comes off the grid of steps, and the encoder is read at that instant.
TEST(SimCore, SyncOffTheGridSamplesAtItsInstant) {
  SimMaster master;
  master.boot();
  press(master);
  master.ticks(30);
  FrameBatch out;
  std::vector<double> positions;
  for (const std::int64_t offset_us : {1000, 1100}) {
    const std::int64_t time_us = master.time_us + offset_us;
    master.sim.receive(0, canopen::sync_frame(), time_us);
    out.clear();
    master.sim.advance_to(time_us, out);
    for (const BusFrame& answer : out) {
      if (answer.frame.id != canopen::tpdo_id(0, 2)) continue;
      positions.push_back(static_cast<std::int32_t>(canopen::get_le(answer.frame.data.data(), 4)));
    }
  }
  ASSERT_EQ(positions.size(), 2U);
  const double speed_rad_s = master.sim.truth().joints[1].true_velocity_rad_s;
  ASSERT_GT(std::abs(speed_rad_s), 0.1);
  EXPECT_NEAR((positions[1] - positions[0]) / kCoreCountsPerRad, 1e-4 * speed_rad_s,
              1e-5 * std::abs(speed_rad_s));
}

TEST(SimCore, FramesThatComeLateActAtThePresent) {
  SimMaster master;
  master.boot();
  FrameBatch out;
  master.sim.advance_to(master.time_us + 5000, out);
  out.clear();
  master.sim.receive(0, canopen::sync_frame(), master.time_us + 1000);
  master.sim.advance_to(master.time_us + 1000, out);
  EXPECT_EQ(out.size(), 4);  // sample and mode of both
}

/// operator new alone is counted: MuJoCo has its own.
TEST(SimCore, AllocatesNothingWhileItRuns) {
  SimMaster master;
  master.boot();
  master.enable();
  FrameBatch burst;
  burst.push(0, SimMaster::rpdo1(1, {100, 0, 10}));
  burst.push(0, SimMaster::rpdo1(2, {-100, 0, 10}));
  burst.push(0, canopen::sdo_read_request(1, {canopen::kModeDisplay, 0}));
  burst.push(0, canopen::sync_frame());
  FrameBatch out;
  SimControl fault;
  fault.kind = SimControlKind::kDriveFault;
  fault.actuator = 1;
  const std::int64_t before = test::allocation_count();
  for (int i = 0; i < 100; ++i) {
    if (i == 50) master.sim.control(fault);
    master.sim.receive_burst(burst, master.time_us, master.time_us + 1000);
    master.time_us += 1000;
    out.clear();
    master.sim.advance_to(master.time_us, out);
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_GT(out.size(), 0);
}

}  // namespace
}  // namespace sprung::sim
