#include "drivers/sim/sim_core.h"

#include <algorithm>
#include <cmath>

#include "drivers/can/can_errors.h"
#include "tests/drivers/sim_test_master.h"
#include "tests/support/allocation_count.h"

namespace sprung::sim {
namespace {

constexpr double kPerMille_Nm = 1e-3 * 0.308 * 100.0;  // rated motor torque 7 A * 0.044 Nm/A, ratio 100
constexpr double kCountsPerRad = 131072.0 * 100.0 / 6.283185307179586;

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
  EXPECT_NEAR(held / kCountsPerRad, 3.2733, 1e-6);
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
    const double true_rad = truth.joints[static_cast<std::size_t>(node - 1)].true_position_rad;
    EXPECT_NEAR(drive.position_counts, true_rad * kCountsPerRad, 1.0);
    EXPECT_LT(std::abs(drive.torque_per_mille) * kPerMille_Nm, 4 * 0.5);
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
  EXPECT_NEAR(master.drives[2].position_counts, start, 0.05 * kCountsPerRad);
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
  const int before = master.drives[2].tpdo2_count;
  const std::int32_t here = master.drives[2].position_counts;
  master.drive(3, {{1, {0, 0, 10}}, {2, {0, here, 8}}});
  EXPECT_EQ(master.drives[2].mode, 8);
  EXPECT_EQ(master.drives[2].tpdo2_count, before + 1);
  EXPECT_EQ(master.drives[1].mode, 10);
}

TEST(SimCore, LostHeartbeatTakesThePowerAfterTwentyMilliseconds) {
  SimMaster master;
  master.boot();
  master.enable();
  master.drive(5, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  ASSERT_TRUE(master.powered(2));
  master.heartbeat = false;
  master.drive(18, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  EXPECT_TRUE(master.powered(2));
  master.drive(5, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  EXPECT_FALSE(master.powered(1));
  EXPECT_FALSE(master.powered(2));
  EXPECT_EQ(master.drives[2].emergencies, std::vector<int>{0x8130});
  EXPECT_EQ(master.sim.truth().joints[1].true_motor_torque_Nm, 0.0);
  EXPECT_EQ(master.read(2, canopen::kErrorRegister), 0x11U);
  master.heartbeat = true;
  master.ticks(3);
  EXPECT_EQ(master.drives[2].emergencies, (std::vector<int>{0x8130, 0}));
  EXPECT_FALSE(master.powered(2));  // never by itself
}

TEST(SimCore, InjectedFaultIsShownAndResets) {
  SimMaster master;
  master.boot();
  master.enable();
  master.control(SimControlKind::kDriveFault, 1, 0.0);
  master.ticks(3);
  EXPECT_EQ(master.drives[2].emergencies, std::vector<int>{0x2310});
  EXPECT_EQ(master.drives[2].status_word & 0x4F, 0x08);
  EXPECT_TRUE(master.powered(1));
  EXPECT_EQ(master.read(2, canopen::kErrorCode), 0x2310U);
  EXPECT_EQ(master.read(2, canopen::kErrorHistory, 1), 0x2310U);
  master.control_word(0x00);
  master.control_word(0x80);
  master.ticks(2);
  EXPECT_EQ(master.drives[2].emergencies, (std::vector<int>{0x2310, 0}));
  EXPECT_EQ(master.drives[2].status_word & 0x4F, 0x40);
  EXPECT_EQ(master.read(2, canopen::kErrorCode), 0U);
}

TEST(SimCore, CutCableSilencesADriveThatThenPowersOff) {
  SimMaster master;
  master.boot();
  master.enable();
  master.control(SimControlKind::kDriveSilent, 0, 1.0);
  master.tick();
  const int answers = master.drives[1].tpdo1_count;
  master.ticks(30);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_TRUE(master.powered(2));
  master.control(SimControlKind::kDriveSilent, 0, 0.0);
  master.ticks(2);
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_FALSE(master.powered(1));
}

TEST(SimCore, BusOffSilencesEveryNodeAndIsToldByErrorFrames) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kBusOff, -1, 0.0, 0.05);
  master.tick();
  ASSERT_EQ(master.error_frames.size(), 1U);
  EXPECT_TRUE(tells_bus_lost(master.error_frames[0]));
  const int answers = master.drives[1].tpdo1_count;
  const std::int64_t cycle = master.sim.cycle();
  master.ticks(40);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_EQ(master.sim.cycle(), cycle + 40);  // the plant lives on
  master.ticks(15);
  ASSERT_EQ(master.error_frames.size(), 2U);
  EXPECT_TRUE(tells_bus_restarted(master.error_frames[1]));
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_FALSE(master.powered(1) || master.powered(2));
  const std::vector<int>& told = master.drives[1].emergencies;
  EXPECT_NE(std::find(told.begin(), told.end(), 0x81FD), told.end());
}

TEST(SimCore, FullQueueKeepsTheMastersFramesFromTheNodes) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kQueueFull, -1, 0.0, 0.01);
  master.tick();
  const int answers = master.drives[1].tpdo1_count;
  master.ticks(5);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_EQ(master.error_frames.size(), 6U);
  EXPECT_TRUE(tells_queue_full(master.error_frames.back()));
  master.ticks(10);
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_TRUE(master.powered(1));  // shorter than the heartbeat consumer's 20 ms
}

TEST(SimCore, EncoderNoiseAndLossesAreTheSameInEveryRun) {
  const auto run = [] {
    SimMaster master;
    master.boot();
    master.fault(FaultKind::kEncoderNoise, 0, 0.001);
    master.fault(FaultKind::kFramesLost, 1, 0.3);
    std::vector<DriveAnswer> answers;
    for (int i = 0; i < 200; ++i) {
      master.tick();
      answers.push_back(master.drives[1]);
      answers.push_back(master.drives[2]);
    }
    EXPECT_NEAR(master.drives[2].tpdo1_count, 0.5 * 200, 40);  // neither all SYNCs heard nor all answers sent
    return answers;
  };
  EXPECT_TRUE(run() == run());
}

TEST(SimCore, SecondDeviceOfOneNodeIdBootsAndAnswersToo) {
  SimMaster master;
  master.boot();
  master.ticks(2);
  const std::size_t states = master.drives[2].nmt_states.size();
  master.fault(FaultKind::kDuplicateNode, 1, 0.0, 0.02);
  master.tick();
  ASSERT_GT(master.drives[2].nmt_states.size(), states);
  EXPECT_EQ(master.drives[2].nmt_states[states], 0x00);
  const int answers = master.drives[2].tpdo1_count;
  const int others = master.drives[1].tpdo1_count;
  master.ticks(10);
  EXPECT_EQ(master.drives[2].tpdo1_count, answers + 20);
  EXPECT_EQ(master.drives[1].tpdo1_count, others + 10);
  master.ticks(20);
  const int after = master.drives[2].tpdo1_count;
  master.ticks(10);
  EXPECT_EQ(master.drives[2].tpdo1_count, after + 10);
}

TEST(SimCore, PowerCycledDriveBootsAgain) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kPowerCycle, 1, 0.0, 0.02);
  master.ticks(10);
  const int answers = master.drives[2].tpdo1_count;
  const std::size_t states = master.drives[2].nmt_states.size();
  master.ticks(20);
  EXPECT_EQ(master.drives[2].tpdo1_count, answers);
  ASSERT_EQ(master.drives[2].nmt_states.size(), states + 1);
  EXPECT_EQ(master.drives[2].nmt_states.back(), 0x00);
  EXPECT_TRUE(master.powered(1));
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
  ASSERT_GT(master.drives[2].position_counts, (2.3595 + 0.05) * kCountsPerRad);
  master.control(SimControlKind::kReset, -1, 0.0);
  master.tick();
  EXPECT_EQ(master.drives[2].position_counts, static_cast<std::int32_t>(std::floor(2.3595 * kCountsPerRad)));
}

/// Answers of a run with torque, noise, a fault and a push in it.
std::vector<DriveAnswer> story(const SimOptions& options) {
  SimMaster master(options);
  master.boot();
  master.enable();
  SimControl push;
  push.apply_at_seq = 100;
  push.wrench = {5, 0, 80, 0, 0, 0};
  push.duration_s = 0.05;
  master.sim.control(push);
  std::vector<DriveAnswer> answers;
  for (int i = 0; i < 400; ++i) {
    const int torque = 200 + i % 50;
    master.drive(1, {{1, {torque / 4, 0, 10}}, {2, {-torque, 0, 10}}});
    answers.push_back(master.drives[1]);
    answers.push_back(master.drives[2]);
  }
  EXPECT_FALSE(master.sim.failed());
  return answers;
}

TEST(SimCore, SameFramesAndSeedGiveTheSameBits) {
  SimOptions options;
  options.plant = {{"sync_jitter_us", 5.0}};
  EXPECT_TRUE(story(options) == story(options));
}

TEST(SimCore, AnotherSeedGivesOtherNoise) {
  SimOptions other;
  other.seed = 2;
  EXPECT_FALSE(story({}) == story(other));
}

TEST(SimCore, TruthOffChangesNothingElse) {
  SimOptions blind;
  blind.truth = false;
  EXPECT_TRUE(story({}) == story(blind));
}

/// What test_axis shows of a run with torque and a push at the arm's end: its drive and its torque sensor.
struct BenchStory {
  std::vector<DriveAnswer> answers;
  std::vector<TorqueSensor> readings;
};

BenchStory bench_story(const SimOptions& options) {
  SimMaster master(options, shipped("test_axis"));
  master.boot();
  master.enable();
  SimControl push;
  push.apply_at_seq = 100;
  push.actuator = 0;
  push.wrench = {20, 0, 0, 0, 0, 0};
  push.duration_s = 0.1;
  master.sim.control(push);
  BenchStory story;
  std::int64_t seen = master.sim.torque_reading_count();
  for (int i = 0; i < 600; ++i) {
    master.drive(1, {{1, {200 + i % 50, 0, 10}}});
    story.answers.push_back(master.drives[1]);
    while (seen < master.sim.torque_reading_count())
      story.readings.push_back(master.sim.torque_reading(seen++));
  }
  EXPECT_FALSE(master.sim.failed());
  return story;
}

bool same_readings(const BenchStory& a, const BenchStory& b) {
  return std::equal(a.readings.begin(), a.readings.end(), b.readings.begin(), b.readings.end(),
                    [](const TorqueSensor& x, const TorqueSensor& y) {
                      return x.measured_torque_Nm == y.measured_torque_Nm &&
                             x.stamp.utime_us == y.stamp.utime_us && x.stamp.seq == y.stamp.seq;
                    });
}

TEST(SimCore, TruthOffChangesNothingOfTheBenchAndItsTorqueSensor) {
  SimOptions blind;
  blind.truth = false;
  const BenchStory seen = bench_story({}), unseen = bench_story(blind);
  EXPECT_TRUE(seen.answers == unseen.answers);
  EXPECT_TRUE(same_readings(seen, unseen));
  SimOptions other;
  other.seed = 2;
  EXPECT_FALSE(same_readings(seen, bench_story(other)));
}

TEST(SimCore, TorqueSensorReadsWhatTheArmFeelsThreeHundredTimesASecond) {
  SimOptions quiet;
  quiet.plant = {{"noise_scale", 0.0}};
  const BenchStory story = bench_story(quiet);
  EXPECT_NEAR(static_cast<double>(story.readings.size()), 180.0, 1.0);
  for (const TorqueSensor& reading : story.readings) EXPECT_EQ(reading.joint, 0);
  SimMaster master(quiet, shipped("test_axis"));
  master.boot();
  EXPECT_LT(master.sim.torque_reading_count(), 2);
  master.enable();
  for (int i = 0; i < 1000; ++i) master.drive(1, {{1, {450, 0, 10}}});  // leans against the weight
  const double true_Nm = master.sim.truth().joints[0].true_gear_output_torque_Nm;
  EXPECT_GT(std::abs(true_Nm), 5.0);
  EXPECT_NEAR(master.sim.torque_sensor().measured_torque_Nm, true_Nm, 0.5 * 0.025 + 0.02);
  EXPECT_LE(master.time_us - master.sim.torque_sensor().stamp.utime_us, 4000);
}

TEST(SimCore, RobotsWithoutATorqueSensorReadNone) {
  SimMaster master;
  master.boot();
  master.ticks(50);
  EXPECT_EQ(master.sim.torque_reading_count(), 0);
  EXPECT_EQ(master.sim.torque_sensor().joint, -1);
}

TEST(SimCore, TorqueConstantOfThePlantScalesTrueTorqueNotTheShownOne) {
  SimOptions strong;
  strong.plant = {{"kt_scale", 1.2}, {"noise_scale", 0.0}};
  SimMaster master(strong);
  master.boot();
  master.enable();
  master.drive(30, {{1, {0, 0, 10}}, {2, {-100, 0, 10}}});
  EXPECT_NEAR(master.drives[2].torque_per_mille, -100, 1);
  EXPECT_NEAR(master.sim.truth().joints[1].true_motor_torque_Nm, -1.2 * 100 * kPerMille_Nm, 1e-3);
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
  EXPECT_NEAR((positions[1] - positions[0]) / kCountsPerRad, 1e-4 * speed_rad_s,
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
  EXPECT_EQ(out.size(), 2);
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

/// Both drives in position mode with the foot `length_m` under the hip: facts (11), (12), knee behind.
void hold_length(SimMaster& master, double length_m) {
  constexpr double kThigh_m = 0.260;
  constexpr double kShank_m = 0.422;
  const double square = length_m * length_m - kShank_m * kShank_m;
  const double knee_rad = std::acos((square - kThigh_m * kThigh_m) / (2 * kThigh_m * kShank_m));
  const double hip_rad = M_PI / 2 + std::acos((square + kThigh_m * kThigh_m) / (2 * kThigh_m * length_m));
  const auto counts = [](double rad) { return static_cast<std::int32_t>(std::lround(rad * kCountsPerRad)); };
  master.drive(1, {{1, {0, counts(hip_rad), 8}}, {2, {0, counts(knee_rad), 8}}});
}

/// Leg length of facts C2's jump, control points raised to degree 6.
double jump_length_m(double time_s) {
  constexpr double kDuration_s = 0.2;
  std::vector<double> points = {0.3500, 0.4028, 0.4258, 0.5060, 0.6340, 0.4905, 0.4780};
  const double share = std::min(time_s / kDuration_s, 1.0);
  for (std::size_t left = points.size() - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) points[i] += share * (points[i + 1] - points[i]);
  }
  return points[0];
}

struct Jump {
  double height_m = 0.0;  ///< rise of the base since the foot left the ground
  int touchdown_ms = 0;
  double hip_output_Nm = 0.0;  ///< gear, push-off
  double knee_output_Nm = 0.0;
};

Jump jump(SimMaster& master) {
  Jump result;
  double take_off_m = 0.0;
  for (int ms = 1; ms <= 800 && result.touchdown_ms == 0; ++ms) {
    hold_length(master, jump_length_m(1e-3 * ms));
    const SimTruth& truth = master.sim.truth();
    const bool in_air = truth.legs[0].true_foot_in_world_m[2] > 0.001;
    if (ms < 200 && !in_air) take_off_m = truth.base_in_world_m[2];
    if (ms > 200 && !in_air) result.touchdown_ms = ms;
    result.height_m = std::max(result.height_m, truth.base_in_world_m[2] - take_off_m);
    if (ms > 150) continue;
    const double hip_Nm = std::abs(truth.joints[0].true_gear_output_torque_Nm);
    const double knee_Nm = std::abs(truth.joints[1].true_gear_output_torque_Nm);
    result.hip_output_Nm = std::max(result.hip_output_Nm, hip_Nm);
    result.knee_output_Nm = std::max(result.knee_output_Nm, knee_Nm);
  }
  return result;
}

/// In position mode, by hand: plant and drives must give what the trials with the same parameters gave.
TEST(SimCore, PlantJ3JumpsAsInTheTrials) {
  SimMaster master;
  master.boot();
  hold_length(master, 0.300);
  master.enable();
  for (int i = 0; i < 1000; ++i) hold_length(master, 0.300 + 0.00005 * i);
  for (int i = 0; i < 500; ++i) hold_length(master, 0.350);
  const Jump result = jump(master);
  EXPECT_FALSE(master.sim.failed());
  EXPECT_NEAR(result.height_m, 0.187, 0.0187);  // facts physics, single leg: 186.9 mm, 552.8 ms
  EXPECT_NEAR(result.touchdown_ms, 553, 10);
  EXPECT_NEAR(result.hip_output_Nm, 24.0, 4.0);  // errata E8
  EXPECT_NEAR(result.knee_output_Nm, 33.0, 4.0);
}

}  // namespace
}  // namespace sprung::sim
