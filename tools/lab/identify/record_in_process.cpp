#include "tools/lab/identify/record_in_process.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/identify/loading_pose.h"

namespace sprung::identify {
namespace {

constexpr double kClear_m = 0.1;
constexpr double kSettleLinks_s = 0.5;  ///< links swing out, estimator settles
constexpr double kTimeout_s = 60.0;
constexpr double kStill_rad_s = 0.01;

SimOptions hung_up(const RobotConfig& robot, SimOptions sim, double foot_weight_kg) {
  if (robot.has_feet()) sim.plant.emplace("suspended", hanging_height_m(robot));
  if (foot_weight_kg > 0.0) sim.plant["foot_weight"] = foot_weight_kg;
  return sim;
}

std::string any_preset(const RobotConfig& robot) {
  return robot.presets.empty() ? std::string() : robot.presets.front().name;
}

/// One robot, told one thing after the other.
class Recorder {
 public:
  Recorder(const RobotConfig& robot, const SimOptions& sim, const CycleObserver& watch)
      : config_(robot), robot_(robot, any_preset(robot), sim), watch_(watch) {
    robot_.boot();
    wait(kSettleLinks_s);
    const auto& actuators = robot.actuators;
    const bool referenced = std::all_of(actuators.begin(), actuators.end(),
                                        [](const ActuatorConfig& actuator) { return actuator.referenced; });
    OperatorCommand home;
    home.kind = OperatorKind::kHome;
    if (!referenced) {
      wait_until_still();
      order(home);
    }
    wait(kSettleLinks_s);
  }

  /// A leg that hangs swings out, the longer the less friction its gears have; homing wants it still.
  void wait_until_still() {
    for (double waited_s = 0.0; moves() && waited_s < kTimeout_s; waited_s += kSettleLinks_s)
      wait(kSettleLinks_s);
  }
  double position_rad(int joint) const { return robot_.joint_state().joints[joint].estimated_position_rad; }
  void begin() { recording_ = true; }
  /// @return the cycle in which it took effect.
  std::int64_t order(OperatorCommand command);
  void wait(double seconds) {
    for (std::int64_t k = std::llround(seconds / config_.cycle_s); k > 0; --k) tick();
  }
  std::vector<DriveState> take() { return std::move(states_); }

 private:
  void tick();
  bool moves() const {
    const auto& joints = robot_.joint_state().joints;
    return std::any_of(joints.begin(), joints.end(), [](const EstimatedJoint& joint) {
      return !(std::abs(joint.estimated_velocity_rad_s) < kStill_rad_s);
    });
  }

  const RobotConfig& config_;
  InProcessRobot robot_;
  const CycleObserver& watch_;
  std::vector<DriveState> states_;
  std::int64_t orders_ = 0;
  bool recording_ = false;
};

void Recorder::tick() {
  robot_.tick();
  if (robot_.sim().failed())
    throw std::runtime_error(std::string("the simulated plant failed: ") + robot_.sim().failure());
  if (!recording_) return;
  states_.push_back(robot_.drive_state());
  if (watch_)
    watch_({robot_.drive_state(), robot_.joint_state(), robot_.motion_state(), robot_.drive_command(),
            robot_.truth(), robot_.leg_command()});
}

std::int64_t Recorder::order(OperatorCommand command) {
  command.request_id = ++orders_;
  robot_.submit(command);
  const std::int64_t last = robot_.cycle() + std::llround(kTimeout_s / config_.cycle_s);
  while (robot_.cycle() < last) {
    tick();
    for (OperatorReply reply; robot_.next_reply(reply);) {
      if (reply.outcome == OperatorOutcome::kDone) return reply.took_effect_at_seq;
      if (reply.outcome != OperatorOutcome::kAccepted)
        throw std::runtime_error(std::string("the robot ") + name(reply.outcome) + " '" + name(command.kind) +
                                 "': " + reply.reason);
    }
  }
  throw std::runtime_error(std::string("'") + name(command.kind) + "' does not end");
}

}  // namespace

double hanging_height_m(const RobotConfig& robot) {
  double longest_m = 0.0;
  for (const LegConfig& leg : robot.legs) {
    double length_m = 0.0;
    for (const LinkConfig& link : leg.links) length_m += link.length_m;
    longest_m = std::max(longest_m, length_m);
  }
  return longest_m > 0.0 ? longest_m + kClear_m : 0.0;
}

JointRecording record_in_process(const RobotConfig& robot, const SimOptions& sim, int joint,
                                 const RecordOptions& options, const CycleObserver& watch) {
  const RecordRange range = narrowed(record_range(robot, joint), options.asked);
  Recorder recorder(robot, hung_up(robot, sim, options.foot_weight_kg), watch);
  JointRecording out;
  if (options.loaded) out.moves = loading_moves(robot, joint);
  for (const RecordMove& move : record_protocol(range, recorder.position_rad(joint), options))
    out.moves.push_back(move);
  recorder.begin();
  for (const RecordMove& move : out.moves) {
    OperatorCommand command;
    command.kind = OperatorKind::kMoveJoint;
    command.joint = move.joint < 0 ? joint : move.joint;
    command.joint_target_rad = move.target_rad;
    command.joint_speed_rad_s = move.speed_rad_s;
    command.joint_acceleration_rad_s2 = move.acceleration_rad_s2;
    out.began_at_seq.push_back(recorder.order(command));
    recorder.wait(move.pause_s);
  }
  out.states = recorder.take();
  return out;
}

}  // namespace sprung::identify
