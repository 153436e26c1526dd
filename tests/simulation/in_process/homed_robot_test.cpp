/// `sprung home` against the simulated drives: what a joint is believed to be afterwards, held against where
/// it truly is, and the torque that waits for it. Each robot is a copy of a shipped one whose robot.yaml asks
/// for the method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "robots/robot_loader.h"
#include "signals/angles.h"
#include "simulation/in_process/inprocess_robot.h"
#include "simulation/plant/sim_config.h"
#include "tests/support/changed_robot.h"
#include "tests/support/own_folder.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

/// Of one count of the motor encoder, at the gear's output.
double count_rad(const ActuatorConfig& a) { return kTurn_rad / (a.encoder_counts_per_turn * a.gear_ratio); }

/// New text for a line of the n-th actuator, counted by its first line, which begins with `item`; "" leaves
/// it.
using LineEdit = std::function<std::string(const std::string& line, int nth)>;

void write_edited(const std::string& text, const std::string& to, const std::string& item,
                  const LineEdit& edit) {
  std::istringstream in(text);
  std::ofstream out(to);
  int nth = -1;
  for (std::string line; std::getline(in, line);) {
    if (line.find(item) == 0 && line.find("_motor") != std::string::npos) ++nth;
    const std::string changed = edit(line, nth);
    out << (changed.empty() ? line : changed) << '\n';
  }
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::fixed << value;
  return text.str();
}

class Homing : public testing::Test {
 protected:
  /// A copy of a shipped robot, its robot.yaml and sim.yaml edited by line.
  RobotConfig copy_of(const std::string& name, const LineEdit& robot_edit, const LineEdit& sim_edit) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string folder = test::temp_dir() + "homing_" + test->name();
    const std::string shipped = robot_folder(name);
    std::filesystem::create_directories(folder);
    std::filesystem::copy_file(shipped + "/model.xml", folder + "/model.xml",
                               std::filesystem::copy_options::overwrite_existing);
    write_edited(test::typed_out_yaml(name), folder + "/robot.yaml", "  - name: ", robot_edit);
    write_edited(test::typed_out_yaml(name, "sim.yaml"), folder + "/sim.yaml", "  - actuator: ", sim_edit);
    return load_robot(folder);
  }
  void boot(const RobotConfig& config) {
    config_ = config;
    SimOptions sim;
    if (config.body.mass_kg > 0.0) sim.plant["suspended"] = 0.8;  // hands can move legs that hang
    robot_ = std::make_unique<InProcessRobot>(config_, "best", sim);
    robot_->boot();
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / config_.cycle_s)); ++i) robot_->tick();
  }
  /// @return "done WHAT", "refused WHY" or the like: the last reply.
  std::string ask(OperatorKind kind, double timeout_s = 2.0) {
    OperatorCommand command;
    command.kind = kind;
    command.request_id = ++request_;
    robot_->submit(command);
    OperatorReply reply;
    std::string last = "no reply";
    for (double waited_s = 0.0; waited_s < timeout_s; waited_s += config_.cycle_s) {
      while (robot_->next_reply(reply)) last = std::string(name(reply.outcome)) + " " + reply.reason;
      if (last != "no reply" && last.find("accepted") != 0) return last;
      robot_->tick();
    }
    return last;
  }
  /// A hand at the foot of every leg, then nobody.
  void push_feet(double force_N, double seconds) {
    for (std::size_t leg = 0; leg < config_.legs.size(); ++leg) {
      SimControl push;
      push.apply_at_seq = robot_->cycle() + 1;
      push.actuator = static_cast<int>(leg);
      push.wrench = {force_N, force_N, -force_N, 0, 0, 0};
      push.duration_s = seconds;
      robot_->sim().control(push);
      run(seconds + 0.2);
    }
  }
  void fault(FaultKind kind, int actuator, double seconds) {
    SimControl control;
    control.kind = SimControlKind::kNodeFault;
    control.apply_at_seq = robot_->cycle() + 1;
    control.actuator = actuator;
    control.fault = kind;
    control.duration_s = seconds;
    robot_->sim().control(control);
  }
  /// Actuator and joint are one: both robots' transmissions are the identity.
  double measured_rad(std::size_t i) const {
    return robot_->drive_state().actuators[i].measured_position_rad;
  }
  double true_rad(std::size_t i) const { return robot_->truth().joints[i].true_position_rad; }
  double error_rad(std::size_t i) const { return measured_rad(i) - true_rad(i); }
  bool referenced(std::size_t i) const { return robot_->drive_state().actuators[i].referenced; }

  RobotConfig config_;
  std::unique_ptr<InProcessRobot> robot_;
  std::int64_t request_ = 0;
};

std::string keep(const std::string&, int) { return ""; }

// ---- pegasus: incremental encoders on the motors, absolute ones behind the gears

class HomingPegasus : public Homing {
 protected:
  /// `reference` of the n-th actuator.
  RobotConfig pegasus(const std::function<std::string(std::size_t)>& reference) {
    return copy_of(
        "pegasus",
        [&](const std::string& line, int nth) {
          const bool own = line.find("    reference: ") == 0;
          return own ? "    reference: " + reference(static_cast<std::size_t>(nth)) : std::string();
        },
        keep);
  }
  /// Lets the legs come to rest and moves every motor by more than a turn, as the index method needs.
  void turn_by_hand() {
    run(0.3);
    std::vector<double> before;
    for (std::size_t i = 0; i < 12; ++i) before.push_back(true_rad(i));
    push_feet(120.0, 0.25);
    run(1.0);
    for (std::size_t i = 0; i < 12; ++i)
      EXPECT_GT(std::abs(true_rad(i) - before[i]), kTurn_rad / 50) << config_.actuators[i].name;
  }
};

TEST_F(HomingPegasus, LinkGivesTheTruthUpToWhatLinkEncodersSee) {
  boot(pegasus([](std::size_t) { return "{method: link, encoder: incremental}"; }));
  const sim::SimConfig plant = sim::load_sim_config(config_, {});
  run(0.5);
  EXPECT_GT(std::abs(error_rad(1)), 1.0) << "before, the count is about nothing";
  ASSERT_EQ(ask(OperatorKind::kHome), "done referenced");
  robot_->tick();
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < 12; ++i) {
      const ActuatorConfig& a = config_.actuators[i];
      ASSERT_TRUE(referenced(i)) << a.name;
      const double noise_rad = plant.cards[a.link_encoder.card].noise_rad;
      const double bound_rad = plant.drives[i].kinematic_error.amplitude_rad + 5 * noise_rad +
                               kTurn_rad / a.link_encoder.counts_per_turn + count_rad(a);
      EXPECT_LT(bound_rad, 4e-4);
      EXPECT_LT(std::abs(error_rad(i)), bound_rad) << a.name << " in round " << round;
    }
    push_feet(120.0, 0.25);
  }
}

class HomingByIndex : public HomingPegasus {
 protected:
  /// References at the index pulses of the shipped plant. The jig is asked for, but a link encoder goes
  /// first.
  RobotConfig with_index(const std::vector<double>& jig_rad) {
    const RobotConfig shipped = load_robot("pegasus");
    const sim::SimConfig plant = sim::load_sim_config(shipped, {});
    return pegasus([&](std::size_t i) {
      const double shaft_rad = plant.drives[i].index_angle_rad / shipped.actuators[i].gear_ratio;
      const double index_rad = shipped.actuators[i].direction * shaft_rad;
      return "{method: index, encoder: incremental, jig: " + number(jig_rad[i]) +
             " rad, index: " + number(index_rad) + " rad}";
    });
  }
  void expect_exact() {
    robot_->tick();
    for (std::size_t i = 0; i < 12; ++i) {
      ASSERT_TRUE(referenced(i));
      EXPECT_LT(std::abs(error_rad(i)), 1.01 * count_rad(config_.actuators[i])) << config_.actuators[i].name;
    }
  }
};

TEST_F(HomingByIndex, IsExactToACountOfTheMotorEncoder) {
  boot(with_index(std::vector<double>(12, 0.0)));
  run(0.3);
  EXPECT_THAT(ask(OperatorKind::kHome), HasSubstr("has seen no index pulse"));
  EXPECT_FALSE(referenced(0));
  turn_by_hand();
  ASSERT_EQ(ask(OperatorKind::kHome), "done referenced");
  expect_exact();
  push_feet(-120.0, 0.25);
  expect_exact();
}

// ---- single_leg with incremental encoders and a jig

class HomingJig : public Homing {
 protected:
  RobotConfig with_jig(double hip_rad, double knee_rad) {
    return copy_of(
        "single_leg",
        [&](const std::string& line, int nth) -> std::string {
          if (line.find("    referenced_on: ") == 0) return "    # a zero that is not there has no date";
          if (line.find("    referenced: true") != 0) return "";
          return "    referenced: false\n    reference: {method: jig, encoder: incremental, jig: " +
                 number(nth == 0 ? hip_rad : knee_rad) + " rad}";
        },
        [](const std::string& line, int) {
          return line.find("  - actuator: ") == 0 ? line + "\n    encoder: incremental" : std::string();
        });
  }
  /// People set the leg down as the simulation begins, and let go: it sinks into its jig.
  void put_in_jig() {
    SimControl reset;
    reset.kind = SimControlKind::kReset;
    reset.apply_at_seq = robot_->cycle() + 1;
    robot_->sim().control(reset);
    run(kRest_s);
  }
  /// Where the leg rests without torque: where its jig is.
  std::vector<double> resting_rad() {
    boot(with_jig(0.0, 0.0));
    put_in_jig();
    return {true_rad(0), true_rad(1)};
  }
  static constexpr double kRest_s = 2.0;
  static constexpr double kCreep_rad = 1e-5;  ///< of a leg at rest, between two moments some cycles apart
};

TEST_F(HomingJig, IsAsGoodAsTheRobotStandsInIt) {
  const std::vector<double> rest_rad = resting_rad();
  const std::vector<double> aside_rad = {0.01, -0.02};
  boot(with_jig(rest_rad[0] + aside_rad[0], rest_rad[1] + aside_rad[1]));
  put_in_jig();
  ASSERT_EQ(ask(OperatorKind::kHome), "done referenced");
  robot_->tick();
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(referenced(i));
    EXPECT_NEAR(error_rad(i), aside_rad[i], kCreep_rad);
  }
}

TEST_F(HomingJig, TorqueWaitsForItAndIsLostWithThePowerOfADrive) {
  const std::vector<double> rest_rad = resting_rad();
  boot(with_jig(rest_rad[0], rest_rad[1]));
  run(0.5);
  const auto stand_is_refused = [&] {
    const std::string said = ask(OperatorKind::kStand) + "; " + robot_->bridge().safety().detail.data();
    EXPECT_THAT(said, HasSubstr("not referenced"));
    run(1.0);
    for (const ActuatorState& a : robot_->drive_state().actuators)
      EXPECT_NE(a.power_state, PowerState::kOperationEnabled);
    ask(OperatorKind::kSit);
    run(0.5);
  };
  const auto stands = [&] {
    put_in_jig();
    EXPECT_EQ(ask(OperatorKind::kClear, 5.0).find("done"), 0U) << "a leg set down in no time has jumped";
    EXPECT_EQ(ask(OperatorKind::kHome), "done referenced");
    EXPECT_EQ(ask(OperatorKind::kStand, 6.0).find("done"), 0U) << robot_->bridge().safety().detail.data();
    EXPECT_NEAR(robot_->truth().base_in_world_m[2], 0.45, 0.02) << "stand_length of robot.yaml";
  };
  stand_is_refused();
  stands();
  fault(FaultKind::kPowerCycle, 1, 0.2);
  run(2.0);
  EXPECT_TRUE(referenced(0));
  EXPECT_FALSE(referenced(1)) << "its count began anew";
  EXPECT_EQ(ask(OperatorKind::kClear, 5.0).find("done"), 0U);
  EXPECT_FALSE(referenced(1)) << "clear finds no zero";
  stand_is_refused();
  stands();
}

}  // namespace
}  // namespace sprung
