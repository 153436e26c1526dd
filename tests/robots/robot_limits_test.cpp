/// Every limit of robots/pegasus/robot.yaml acts: each is made tighter in the file, and what then happens is
/// what it is for, and nothing else; with the file as it is, nothing happens in the same seconds. Which
/// numbers there are is asked of the loader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <regex>

#include "robots/robot_numbers.h"
#include "tests/support/disturbed_stack.h"
#include "tests/support/mutated_robot.h"

namespace sprung {
namespace {

using sprung::test::DisturbedStack;
using Acts = std::set<std::string>;
using Deeds = std::function<void(DisturbedStack&)>;

constexpr int kPlace = 2;  ///< in lists: front left's knee and its motor

struct Limit {
  std::string path;
  std::string tighter;
  Acts acts;
  Deeds then;             ///< from standing
  bool on_floor = false;  ///< else it hangs: faster to simulate
  Acts as_it_is{};        ///< what acts already with the file as it is
};

/// Numbers that say what the robot is, or how softly it moves, and hold nothing back.
constexpr const char* kNoLimits[] = {
    // what it is made of, and what is known of that
    R"((cycle_rate|bit_rate))", R"(processes\[\].*)", R"(encoder_cards\[\]\..*)",
    R"(actuators\[\]\.(identity\..*|node|gear_ratio|direction|torque_constant|encoder_counts|pole_pairs))",
    R"(actuators\[\]\.(offset|link_encoder\..*|reference\..*|speed_limit_object|position_limits_object))",
    R"(joints\[\]\.(armature|coulomb_friction|friction\..*|identified\..*|uncertainty\..*))",
    R"(legs\[\]\.(hip_in_trunk\..|links\[\]\..*|transmission|foot_radius))",
    R"(body\.(mass|com\..|inertia\..|imu_latency))",
    // what the estimator takes for granted
    R"(estimation\..*)",
    // gains, and what contact is
    R"(actuators\[\]\.(position_loop\..*|safety_damping))", R"(legs\[\]\.contact\..*)",
    // gaits as data; one that stands goes nowhere already
    R"(gaits\.\w+\.(approach_speed|duty|height|lift|offsets|period|pre_stance|sway))",
    R"(gaits\.stand\.fastest\.\w+)",
    // laws of motion
    R"(presets\.\w+\.(stand_length|sit_length|rise_time|settle_time|recover_time|stiffness_ramp))",
    R"(presets\.\w+\.(friction_compensation|friction_smoothing|rest_friction\..*|compliance\..*))",
    R"(presets\.\w+\.walk\.(stance|swing|pre_stance|body_stiffness|body_damping|speed_damping)\..*)",
    R"(presets\.\w+\.walk\.standing_friction_share)",
    R"(presets\.\w+\.walk\.(floor_friction|stance_width|force_rise|approach_speed|foothold_gain))",
    R"(presets\.\w+\.walk\.(acceleration|turning_acceleration|stance_friction_compensation|swing_compensation\..*))",
    // how often heartbeats are sent: those who miss them have limits
    R"((simulation_)?watchdogs\.heartbeat)"};

OperatorCommand walk(const std::string& gait, const Vec3& speed = {}) {
  static const RobotConfig robot = load_robot("pegasus");
  OperatorCommand command;
  command.kind = OperatorKind::kWalk;
  command.walk_speed = speed;
  for (std::size_t i = 0; i < robot.gaits.size(); ++i)
    if (robot.gaits[i].name == gait) command.gait = static_cast<int>(i);
  return command;
}

Deeds walking(const std::string& gait, const Vec3& speed, double seconds) {
  return [=](DisturbedStack& robot) {
    robot.ask(walk(gait, speed));
    robot.run(seconds);
  };
}

Deeds stalling(bool DisturbedStack::Missing::*who, int cycles) {
  return [=](DisturbedStack& robot) {
    robot.missing.*who = true;
    robot.run_cycles(cycles);
    robot.missing.*who = false;
    robot.run(0.1);
  };
}

Deeds faulting(FaultKind kind, double value, double duration_s) {
  return [=](DisturbedStack& robot) {
    robot.fault(kind, kPlace, value, duration_s);
    robot.run(duration_s + 0.1);
  };
}

void stand_still(DisturbedStack& robot) { robot.run(0.3); }

/// On springs, hanging: what the change from position control does is over.
void stand_on_springs(DisturbedStack& robot) {
  robot.ask(walk("stand"));
  robot.run(0.1);
  robot.watch();
  robot.run(0.3);
}

/// As if somebody sat on it: more than the motors give for long.
void carry(DisturbedStack& robot) {
  robot.ask(walk("stand"));
  robot.push({0, 0, -300, 0, 0, 0}, 1.5);
  robot.run(1.5);
}

void stand_lower(DisturbedStack& robot) {
  OperatorCommand lower = walk("stand");
  lower.body_height_m = 0.42;
  robot.ask(lower);
  robot.run(2.0);
}

void lose_ground_at_the_left(DisturbedStack& robot) {
  for (const int leg : {0, 2}) robot.floor(-0.06, leg);
  robot.run(1.0);
}

void step_into_a_hole(DisturbedStack& robot) {
  robot.floor(-0.02, 0);
  robot.ask(walk("crawl"));
  robot.run(5.0);
}

void overrun(DisturbedStack& robot) {
  for (int i = 0; i < 5; ++i) robot.overrun();
  robot.run_cycles(2);
}

void add_joints(std::vector<Limit>& limits) {
  const Deeds slowly = walking("trot", {0.1, 0.0, 0.0}, 2.0);
  for (const Limit& limit : std::vector<Limit>{
           {"actuators[].torque_limit", "25 Nm", {"torque"}, carry, true},
           {"actuators[].speed_limit", "1 rad/s", {"speed"}, slowly, true},
           {"actuators[].power_limit", "1 W", {"power"}, slowly, true},
           {"actuators[].rated_current", "0.35 A", {"drive's current"}, walking("stand", {}, 3.0), true},
           {"actuators[].winding_time_constant", "0.1 s", {"drive's current"}, carry, true},
           {"joints[].position.min", "1.1 rad", {"position"}, stand_still},
           {"joints[].position.max", "0.9 rad", {"position"}, stand_still},
           {"joints[].position.min", "1.1 rad", {"soft stop"}, stand_on_springs},
           {"joints[].position.max", "1.3 rad", {"soft stop"}, stand_lower, true}})
    limits.push_back(limit);
}

void add_body(std::vector<Limit>& limits) {
  limits.push_back({"body.fallen.tilt", "0.1 rad", {"fallen"}, lose_ground_at_the_left, true});
  limits.push_back({"body.fallen.height", "0.47 m", {"fallen"}, stand_lower, true});
  limits.push_back({"presets.best.walk.step_down", "0 m", {"no ground"}, step_into_a_hole, true});
  limits.push_back({"presets.paper.walk.step_down", "0 m", {"no ground"}, step_into_a_hole, true});
}

void add_gaits(std::vector<Limit>& limits) {
  const std::array<const char*, 3> axes{"forward", "sideways", "turning"};
  for (const std::string gait : {"crawl", "walk", "trot"}) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      Vec3 speed{};
      speed[axis] = 0.02;
      limits.push_back({"gaits." + gait + ".fastest." + axes[axis],
                        axis == 2 ? "0.01 rad/s" : "0.01 m/s",
                        {std::string("faster ") + axes[axis] + " than this gait goes"},
                        walking(gait, speed, 0.1)});
    }
    limits.push_back({"gaits." + gait + ".fastest.backward",
                      "0.01 m/s",
                      {"faster backward than this gait goes"},
                      walking(gait, {-0.02, 0.0, 0.0}, 0.1)});
  }
}

void add_watchdogs(std::vector<Limit>& limits, const std::string& which) {
  using Missing = DisturbedStack::Missing;
  const auto add = [&](const char* key, const char* tighter, const Acts& acts, const Deeds& then) {
    limits.push_back({which + "." + key, tighter, acts, then});
  };
  add("command_hold", "4 ms", {"command stale"}, stalling(&Missing::drive_command, 5));
  add("leg_command", "4 ms", {"leg command stale: lowering"}, stalling(&Missing::leg_command, 5));
  add("joint_state", "4 ms", {"estimator starts anew", "joint not ready"},
      stalling(&Missing::drive_state, 5));
  add("heartbeat_consumer", "10 ms", {"drive fault, latched"}, stalling(&Missing::heartbeat, 8));
  add("drive_heartbeat", "20 ms", {"drive silent, latched"}, faulting(FaultKind::kHeartbeatStopped, 0, 0.05));
  // Its joint is then not measured, which the estimator says too.
  add("silent_cycles", "0", {"drive silent, latched", "estimator starts anew"},
      faulting(FaultKind::kFramesLost, 1.0, 0.002));
  add("overruns_in_row", "3", {"overruns"}, overrun);
  // Half way there command_hold has acted.
  add("command_stop", "70 ms", {"command stale", "command stale, latched"},
      stalling(&Missing::drive_command, 45));
  limits.back().as_it_is = {"command stale"};
}

std::vector<Limit> all_limits() {
  std::vector<Limit> limits;
  add_joints(limits);
  add_body(limits);
  add_gaits(limits);
  for (const char* which : {"watchdogs", "simulation_watchdogs"}) add_watchdogs(limits, which);
  return limits;
}

std::string replaced_all(const std::string& text, const char* what, const std::string& by) {
  return std::regex_replace(text, std::regex(what), by);
}

/// The same law, but with the number that this preset says.
void borrow_step_down(RobotConfig& robot, const std::string& from) {
  for (PresetConfig& preset : robot.presets)
    if (preset.name == "best") preset.walk.step_down_m = robot.preset(from).walk.step_down_m;
}

/// What acts on a robot with this file.
Acts what_acts(RobotConfig robot, const Limit& limit) {
  if (limit.path.rfind("simulation_", 0) == 0) robot.watchdogs = robot.simulation_watchdogs;
  if (limit.path.rfind("presets.paper", 0) == 0) borrow_step_down(robot, "paper");
  std::map<std::string, double> plant;
  if (!limit.on_floor) plant["suspended"] = 0.8;
  DisturbedStack stack(robot, plant);
  stack.stand_up();
  stack.watch();
  limit.then(stack);
  return stack.acted();
}

void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.path << ": " << limit.tighter; }

class RobotLimit : public ::testing::TestWithParam<Limit> {};

TEST_P(RobotLimit, ActsWhenItIsTighterAndNotAsItIs) {
  const Limit& limit = GetParam();
  const std::string place = "[" + std::to_string(kPlace) + "]";
  const test::MutatedRobot pegasus("pegasus");
  EXPECT_EQ(what_acts(load_robot("pegasus"), limit), limit.as_it_is);
  EXPECT_EQ(what_acts(pegasus.with(replaced_all(limit.path, R"(\[\])", place), limit.tighter), limit),
            limit.acts);
}

std::string test_name(const ::testing::TestParamInfo<Limit>& info) {
  return replaced_all(info.param.path, "[^a-z]+", "_") + "_" + std::to_string(info.index);
}

INSTANTIATE_TEST_SUITE_P(Pegasus, RobotLimit, ::testing::ValuesIn(all_limits()), test_name);

TEST(RobotLimits, EveryNumberOfTheFileIsALimitThatIsTestedHereOrKnownToBeNone) {
  Acts tested, patterns;
  for (const Limit& limit : all_limits()) tested.insert(limit.path);
  for (const std::string& path : robot_numbers("pegasus"))
    patterns.insert(replaced_all(path, R"(\[\d+\])", "[]"));
  for (const std::string& pattern : patterns) {
    const bool none = std::any_of(std::begin(kNoLimits), std::end(kNoLimits), [&](const char* known) {
      return std::regex_match(pattern, std::regex(known));
    });
    EXPECT_NE(none, tested.count(pattern) == 1)
        << pattern << ": a limit needs a case in all_limits(), any other number a line in kNoLimits";
  }
  for (const std::string& path : tested)
    EXPECT_EQ(patterns.count(path), 1U) << path << " is not read any more";
}

}  // namespace
}  // namespace sprung
