/// The walk on a simulated bench: values on the bus in, a protocol out.
#include "tools/can/commission/walk.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"
#include "tools/can/commission/simulated_bench.h"
#include "tools/can/commission/wired_drives.h"
#include "tools/can/decode/bus_description.h"

namespace sprung::commission {
namespace {

constexpr canopen::ObjectId kConsumer{0x1016, 1}, kAbort{0x6007, 0}, kPulses{0x2210, 1}, kStatus{0x6041, 0};

/// The first drive of a robot on the bench.
struct Bench {
  explicit Bench(const std::string& name, bool factory = false) : robot(load_robot(name)) {
    setup.sim.wiring.resize(robot.actuators.size());
    setup.sim.wiring[0] = factory ? factory_drive(robot.actuators[0])
                                  : commissioned_drive(robot.actuators[0]);
  }
  sim::DriveWiring& wiring() { return setup.sim.wiring[0]; }
  void open() { bench = std::make_unique<SimulatedBench>(robot, setup); }
  Protocol walk(const WalkOptions& options = {}) {
    if (!bench) open();
    return Walk(robot, 0, cantools::drive_timing(robot, robot.watchdogs), options, *bench, *bench).run();
  }
  std::uint32_t value(canopen::ObjectId object) {
    return bench->read(robot.actuators[0].node, object).number();
  }

  RobotConfig robot;
  BenchSetup setup;
  std::unique_ptr<SimulatedBench> bench;
};

std::string all_text(const Protocol& protocol) {
  std::string text;
  for (const Step& step : protocol.steps) text += step_text(step);
  return text;
}

bool is_off(Bench& bench) { return (bench.value(kStatus) & 0x6F) != 0x27; }

TEST(CommissioningWalk, RightDrivesOfBothMakesPassAndAreLeftAsTheyWere) {
  for (const char* name : {"single_leg", "pegasus"}) {
    Bench bench(name);
    bench.open();
    const std::uint32_t consumer = bench.value(kConsumer), abort = bench.value(kAbort);
    const Protocol protocol = bench.walk();
    EXPECT_TRUE(protocol.ok()) << name << "\n" << all_text(protocol);
    EXPECT_EQ(bench.value(kConsumer), consumer);
    EXPECT_EQ(bench.value(kAbort), abort);
    EXPECT_TRUE(is_off(bench));
    EXPECT_LT(bench.bench->truth().largest_motion_rad, 0.05);
    EXPECT_LE(protocol.exposure.torque_Nm, protocol.torque_cap_Nm);
  }
}

TEST(CommissioningWalk, AFactoryDriveIsNamedAndWithWriteItIsSetAndPasses) {
  Bench named("pegasus", true);
  const Protocol before = named.walk();
  EXPECT_FALSE(before.ok());
  EXPECT_EQ(before.torque_cap_Nm, 0.0) << "no power before it is right";
  Bench bench("pegasus", true);
  bench.robot.actuators[0].commissioning.current_p = 800;
  bench.robot.actuators[0].commissioning.current_i = 160;
  bench.wiring() = factory_drive(bench.robot.actuators[0]);
  WalkOptions options;
  options.write = true;
  const Protocol after = bench.walk(options);
  EXPECT_TRUE(after.ok()) << all_text(after);
  EXPECT_EQ(bench.value(kPulses), 4096U);
  const auto stored = std::count_if(after.written.begin(), after.written.end(), [](const std::string& line) {
    return line.find(", stored") != std::string::npos;
  });
  EXPECT_GE(stored, 5);
  for (const std::string& line : after.written) {
    const bool borrowed = line.find("for this walk") != std::string::npos;
    EXPECT_TRUE(!borrowed || std::count(after.written.begin(), after.written.end(), line) == 1) << line;
  }
}

TEST(CommissioningWalk, NothingIsWrittenWithoutWrite) {
  Bench bench("pegasus", true);
  bench.open();
  const std::uint32_t pulses = bench.value(kPulses);
  const Protocol protocol = bench.walk();
  EXPECT_EQ(bench.value(kPulses), pulses);
  for (const std::string& line : protocol.written) EXPECT_EQ(line.rfind("0x6040", 0), 0U) << line;
}

TEST(CommissioningWalk, WithoutPowerItEndsAfterTheHand) {
  Bench bench("single_leg");
  WalkOptions options;
  options.power = false;
  const Protocol protocol = bench.walk(options);
  EXPECT_EQ(protocol.steps.back().name, "turned by hand");
  EXPECT_EQ(bench.bench->truth().highest_torque_Nm, 0.0);
}

TEST(CommissioningWalk, AStrangerIsReadNoFurther) {
  Bench bench("pegasus");
  bench.wiring().stored.emplace_back(canopen::ObjectId{0x1018, 3}, 0x21100000);
  const Protocol protocol = bench.walk();
  EXPECT_EQ(protocol.steps.back().name, "maker and firmware");
  EXPECT_NE(all_text(protocol).find("0x21100000"), std::string::npos);
  EXPECT_TRUE(protocol.written.empty());
}

TEST(CommissioningWalk, PowerThatIsLostWhileADriveIsWrittenSaysWhatMayHaveBeenLost) {
  Bench bench("pegasus", true);
  bench.open();
  bench.bench->break_at("limits", 6, [](SimulatedBench& b) { b.fault(FaultKind::kPowerCycle, 0.0, 30.0); });
  WalkOptions options;
  options.write = true;
  const Protocol protocol = bench.walk(options);
  EXPECT_EQ(protocol.first_difference(), "limits");
  EXPECT_NE(all_text(protocol).find("no answer"), std::string::npos);
  ASSERT_GE(protocol.written.size(), 3U) << "motor and encoder were written before";
  for (const std::string& line : protocol.written) {
    const bool reset = line.rfind("0x6040", 0) == 0;
    EXPECT_TRUE(reset || line.find("not stored") != std::string::npos) << line;
  }
  EXPECT_EQ(bench.bench->truth().highest_torque_Nm, 0.0);
}

TEST(CommissioningWalk, ADriveThatDiesUnderTorqueIsNamedAndDoesNotMoveAgain) {
  Bench bench("single_leg");
  bench.open();
  bench.bench->break_at("commutation and signs", 150,
                        [](SimulatedBench& b) { b.fault(FaultKind::kPowerCycle, 0.0, 0.1); });
  const Protocol protocol = bench.walk();
  EXPECT_EQ(protocol.first_difference(), "commutation and signs");
  EXPECT_TRUE(is_off(bench));
  bench.bench->wait(1.0);
  EXPECT_EQ(bench.bench->sim().true_motor_torque_Nm(0), 0.0);
}

TEST(CommissioningWalk, CtrlCUnderTorqueSwitchesOffAndPutsBack) {
  Bench bench("single_leg");
  bench.open();
  const std::uint32_t consumer = bench.value(kConsumer);
  bench.bench->break_at("commutation and signs", 200, [](SimulatedBench& b) { b.stop(); });
  const Protocol protocol = bench.walk();
  EXPECT_NE(all_text(protocol).find("stopped by the operator"), std::string::npos);
  EXPECT_TRUE(is_off(bench));
  EXPECT_EQ(bench.value(kConsumer), consumer);
}

TEST(CommissioningWalk, ADriveThatHearsNobodyAnyMoreSwitchesOffByItself) {
  Bench bench("single_leg");
  bench.open();
  bench.bench->break_at("commutation and signs", 250, [](SimulatedBench& b) {
    SimControl cut;
    cut.kind = SimControlKind::kDriveSilent;
    cut.actuator = 0;
    cut.value = 1.0;
    b.sim().control(cut);
  });
  const Protocol protocol = bench.walk();
  EXPECT_EQ(protocol.first_difference(), "commutation and signs");
  EXPECT_EQ(bench.bench->sim().true_motor_torque_Nm(0), 0.0);
  EXPECT_LT(bench.bench->truth().largest_motion_rad, 0.05);
  EXPECT_NE(summary_text(protocol).find("NOT put back"), std::string::npos);
}

/// Loses writes of control word 0, and refuses to show the current, when told.
class BadPort final : public DrivePort {
 public:
  explicit BadPort(SimulatedBench& bench) : bench_(bench) {}
  SdoAnswer read(int node, canopen::ObjectId object) override {
    if (object == canopen::ObjectId{0x6078, 0} && hides_current && powered_) {
      SdoAnswer refused;
      refused.status = canopen::SdoStatus::kAborted;
      return refused;
    }
    return bench_.read(node, object);
  }
  SdoAnswer write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) override {
    const bool control = object == canopen::ObjectId{0x6040, 0};
    if (control && bytes[0] == 0x0F) powered_ = true;
    if (!control || bytes[0] != 0 || !powered_ || lost_words-- <= 0) return bench_.write(node, object, bytes);
    bench_.wait(0.0);
    SdoAnswer silence;
    silence.status = canopen::SdoStatus::kTimeout;
    return silence;
  }
  void send(const CanFrame& frame) override { bench_.send(frame); }
  void beat() override { bench_.beat(); }
  void wait(double seconds) override { bench_.wait(seconds); }
  double now_s() const override { return bench_.now_s(); }
  std::vector<int> nodes() override { return bench_.nodes(); }
  int boot_ups(int node) const override { return bench_.boot_ups(node); }
  bool stopped() const override { return bench_.stopped(); }

  int lost_words = 0;
  bool hides_current = false;

 private:
  SimulatedBench& bench_;
  bool powered_ = false;
};

Protocol walk_by(BadPort& port, Bench& bench) {
  return Walk(bench.robot, 0, cantools::drive_timing(bench.robot, bench.robot.watchdogs), {}, port,
              *bench.bench)
      .run();
}

TEST(CommissioningWalk, AWordThatIsLostIsSaidAgainBeforeTheWatchIsPutBack) {
  Bench bench("single_leg");
  bench.open();
  const std::uint32_t consumer = bench.value(kConsumer);
  bench.bench->break_at("commutation and signs", 200, [](SimulatedBench& b) { b.stop(); });
  BadPort port(*bench.bench);
  port.lost_words = 2;
  (void)walk_by(port, bench);
  EXPECT_TRUE(is_off(bench));
  EXPECT_EQ(bench.value(kConsumer), consumer);
}

TEST(CommissioningWalk, ADriveThatDoesNotSayThatItIsOffKeepsItsWatchWhichSwitchesItOff) {
  Bench bench("single_leg");
  bench.open();
  bench.bench->break_at("commutation and signs", 200, [](SimulatedBench& b) { b.stop(); });
  BadPort port(*bench.bench);
  port.lost_words = 100;
  const Protocol protocol = walk_by(port, bench);
  EXPECT_NE(summary_text(protocol).find("NOT put back, since the drive"), std::string::npos);
  EXPECT_EQ(bench.value(kConsumer), 0x007F0064U);
  for (int reads = 0; reads < 2000 && !is_off(bench); ++reads) {
  }
  EXPECT_TRUE(is_off(bench)) << "nothing beats any more";
}

TEST(CommissioningWalk, WithoutItsMeasuredCurrentADriveGetsNoPower) {
  Bench bench("single_leg");
  bench.open();
  BadPort port(*bench.bench);
  port.hides_current = true;
  const Protocol protocol = walk_by(port, bench);
  EXPECT_NE(all_text(protocol).find("cannot be read"), std::string::npos);
  EXPECT_EQ(bench.bench->truth().highest_torque_Nm, 0.0);
  EXPECT_TRUE(is_off(bench));
}

TEST(CommissioningWalk, WhateverHappensToThePersonPowerGoesOff) {
  struct Gone {};
  Bench bench("single_leg");
  bench.open();
  bench.bench->on_step([](SimulatedBench&, const std::string& step) {
    if (step == "commutation and signs") throw Gone{};
  });
  EXPECT_THROW(bench.walk(), Gone);
  EXPECT_TRUE(is_off(bench));
}

TEST(CommissioningWalk, PowerThatNobodyWantsIsNotSwitchedOn) {
  struct Unwilling final : Person {
    explicit Unwilling(SimulatedBench& bench) : bench_(bench) {}
    double answer(const Question& question) override {
      return question.ask == Ask::kPower ? 0.0 : bench_.answer(question);
    }
    void begins(const std::string& step) override { bench_.begins(step); }
    void hears(const std::string&) override {}
    SimulatedBench& bench_;
  };
  Bench bench("single_leg");
  bench.open();
  Unwilling person(*bench.bench);
  const Protocol protocol = Walk(bench.robot, 0, cantools::drive_timing(bench.robot, bench.robot.watchdogs),
                                 {}, *bench.bench, person)
                                .run();
  EXPECT_FALSE(protocol.ok());
  EXPECT_EQ(bench.bench->truth().highest_torque_Nm, 0.0);
}

}  // namespace
}  // namespace sprung::commission
