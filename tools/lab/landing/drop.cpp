#include "tools/lab/landing/drop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "model/leg_kinematics.h"
#include "simulation/hash_noise.h"
#include "tools/lab/run/scoring.h"

namespace sprung {
namespace {

constexpr std::int64_t kHangCycle = 10;
constexpr double kTouchdown_N = 1.0;        // true vertical force that counts as touchdown
constexpr double kFoldedMargin_rad = 0.03;  // closer to its folded stop the knee counts as folded
constexpr double kSettleHanging_s = 0.5;    // after standing up, hanging and landed

double fall_s(double height_m) noexcept { return std::sqrt(2.0 * height_m / kGravity_m_s2); }

/// Until a leg of the preset's landing length touches.
double expected_fall_s(const PresetConfig& preset, const DropCase& drop) noexcept {
  return fall_s(drop.height_m + preset.stand_length_m - preset.landing_length_m);
}

/// Where the floor must be for the touchdown to be `surprise_s` late; the expected floor is at 0.
double floor_height_m(double expected_s, const DropCase& drop) noexcept {
  const double speed_m_s = kGravity_m_s2 * expected_s;
  return -drop.surprise_s * (speed_m_s + 0.5 * kGravity_m_s2 * drop.surprise_s);
}

SimControl control(SimControlKind kind, std::int64_t cycle, double value) {
  SimControl out;
  out.kind = kind;
  out.apply_at_seq = cycle;
  out.value = value;
  return out;
}

}  // namespace

double drawn_surprise_s(std::uint64_t seed, double most_s) noexcept {
  constexpr std::uint64_t kSurprise = 0x64726f70;  // a signal of its own
  const std::uint64_t bits = sim::mix_bits(sim::mix_bits(seed) ^ kSurprise);
  return most_s * (2.0 * static_cast<double>(bits >> 11) / 9007199254740992.0 - 1.0);  // 2^53
}

std::int64_t release_cycle(const RobotConfig& robot, const std::string& preset) {
  constexpr double kEnabling_s = 1.0;
  return std::llround((robot.preset(preset).rise_time_s + kEnabling_s + kSettleHanging_s) / robot.cycle_s);
}

RunScript drop_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      const DropCase& drop) {
  const PresetConfig& p = robot.preset(preset);
  const std::int64_t release = release_cycle(robot, preset);
  const double expected_s = expected_fall_s(p, drop);
  RunScript script{robot, preset, sim, {}, 0};
  script.sim.plant["suspended"] = p.stand_length_m + robot.legs.front().foot_radius_m + drop.height_m;
  script.controls = {control(SimControlKind::kFloor, kHangCycle, floor_height_m(expected_s, drop)),
                     control(SimControlKind::kSuspend, release, 0.0)};
  script.commands = {scripted(OperatorKind::kStand, kHangCycle), scripted(OperatorKind::kLand, release)};
  script.commands.back().jump_mode = drop.mode;
  script.commands.back().touchdown_in_s = expected_s;
  const double after_s = expected_s + p.flight_timeout_s + p.landing_hold_s + p.recover_time_s +
                         p.settle_time_s + kSettleHanging_s;
  script.cycles = release + std::llround(after_s / robot.cycle_s);
  return script;
}

DropMetrics::DropMetrics(const RobotConfig& robot, std::int64_t release_cycle)
    : hip_(measured_joint(robot, "hip")),
      knee_(measured_joint(robot, "knee")),
      folded_knee_rad_(robot.joints[knee_].position_max_rad - kFoldedMargin_rad),
      release_cycle_(release_cycle),
      cycle_s_(robot.cycle_s) {}

void DropMetrics::add(const CycleRecord& cycle) {
  const TrueLeg& leg = cycle.truth.legs.front();
  if (cycle.truth.stamp.seq >= release_cycle_) {
    if (!landed_ && leg.true_contact_force_N[2] > kTouchdown_N) touch_down(cycle);
    if (landed_) follow_peaks(cycle);
  }
  foot_height_m_ = leg.true_foot_in_world_m[2];
}

void DropMetrics::touch_down(const CycleRecord& cycle) {
  landed_ = true;
  const double foot_m = cycle.truth.legs.front().true_foot_in_world_m[2];
  result_.touchdown_s = static_cast<double>(cycle.truth.stamp.seq - release_cycle_) * cycle_s_;
  result_.touchdown_speed_m_s = (foot_height_m_ - foot_m) / cycle_s_;
  result_.touchdown_length_m = cycle.truth.base_in_world_m[2] - foot_m;
  result_.shortest_m = result_.touchdown_length_m;
}

void DropMetrics::follow_peaks(const CycleRecord& cycle) {
  const MotionPhase phase = cycle.motion_state.state;
  const double knee_rad = cycle.truth.joints[knee_].true_position_rad;
  const double foot_m = cycle.truth.legs.front().true_foot_in_world_m[2];
  result_.shortest_m = std::min(result_.shortest_m, cycle.truth.base_in_world_m[2] - foot_m);
  at_stop_ = at_stop_ || knee_rad > folded_knee_rad_;
  over_ = over_ || phase == MotionPhase::kRecover || phase == MotionPhase::kIdle;
  stood_ = over_ && phase == MotionPhase::kStanding;
  if (over_) return;
  for (const std::size_t joint : {hip_, knee_}) {
    raise_peak(result_.peak_motor_torque_Nm, cycle.joint_state.joints[joint].motor_side_torque_Nm);
    raise_peak(result_.peak_output_torque_Nm, cycle.truth.joints[joint].true_gear_output_torque_Nm);
  }
  raise_peak(result_.peak_hip_output_torque_Nm, cycle.truth.joints[hip_].true_gear_output_torque_Nm);
}

DropResult DropMetrics::result() const {
  DropResult out = result_;
  out.folded = at_stop_ || !stood_;
  return out;
}

DropResult run_drop(const RunScript& script, const ScriptRunner& run, const CycleObserver& watch) {
  DropMetrics metrics(script.robot, release_cycle(script.robot, script.preset));
  run(
      script,
      [&](const CycleRecord& cycle) {
        metrics.add(cycle);
        if (watch) watch(cycle);
      },
      [](const OperatorReply& reply) {
        if (reply.outcome == OperatorOutcome::kRefused)
          throw std::runtime_error(std::string("the robot refused a command: ") + reply.reason);
      });
  return metrics.result();
}

}  // namespace sprung
