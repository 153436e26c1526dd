#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/joint_limits.h"
#include "robots/robot_loader.h"
#include "tools/commands.h"
#include "tools/operate/client/angle_text.h"
#include "tools/operate/client/joint_mover.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kFirstLook_s = 2.0;
constexpr std::int64_t kTell_us = 500'000;  // of the robot's time

struct MoveRequest {
  std::string joint;
  std::string to;
  std::string by;
  std::string speed;
  std::string acceleration;
  std::string instance = "default";
  std::string robot;
  std::int64_t at_seq = -1;
  bool no_wait = false;
  bool as_json = false;
};

double angle_of(const char* option, const std::string& text, const char* per) {
  try {
    return parse_angle_rad(text, per);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(std::string(option) + ": " + error.what());
  }
}

const EstimatedJoint& look_at(JointMover& mover, int joint) {
  const JointState* state = mover.look(kFirstLook_s);
  if (state == nullptr) throw std::runtime_error("no JOINT_STATE comes in: see sprung status");
  return state->joints[joint];
}

OperatorCommand order_of(const MoveRequest& request, const RobotConfig& robot, JointMover& mover) {
  int joint = -1;
  try {
    joint = joint_named(robot, request.joint);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
  if (request.to.empty() == request.by.empty()) throw WrongUse("say either --to or --by");
  const double target_rad = request.by.empty() ? angle_of("--to", request.to, "")
                                               : look_at(mover, joint).estimated_position_rad +
                                                     angle_of("--by", request.by, "");
  OperatorCommand order = gentle_move(robot, joint, target_rad);
  if (!request.speed.empty()) {
    const double rise_s = order.joint_speed_rad_s / order.joint_acceleration_rad_s2;
    order.joint_speed_rad_s = angle_of("--speed", request.speed, "/s");
    order.joint_acceleration_rad_s2 = order.joint_speed_rad_s / rise_s;
  }
  if (!request.acceleration.empty())
    order.joint_acceleration_rad_s2 = angle_of("--acceleration", request.acceleration, "/s^2");
  order.apply_at_seq = request.at_seq;
  return order;
}

Json answer_json(const MoveRequest& request, const OperatorCommand& order,
                 const std::optional<OperatorAnswer>& answer, double position_rad) {
  return {{"joint", request.joint},
          {"target_rad", order.joint_target_rad},
          {"speed_rad_s", order.joint_speed_rad_s},
          {"acceleration_rad_s2", order.joint_acceleration_rad_s2},
          {"position_rad", std::isfinite(position_rad) ? Json(position_rad) : Json(nullptr)},
          {"outcome", answer ? name(answer->outcome) : "no answer"},
          {"reason", answer ? answer->reason : ""},
          {"cycle", answer ? answer->took_effect_at_seq : -1}};
}

bool went_well(const std::optional<OperatorAnswer>& answer) {
  return answer && answer->outcome != OperatorOutcome::kRefused &&
         answer->outcome != OperatorOutcome::kFailed;
}

void tell_limits(const RobotConfig& robot, const OperatorCommand& order) {
  const auto joint = static_cast<std::size_t>(order.joint);
  const JointLimits limits = joint_limits(robot)[joint];
  std::fprintf(stderr, "limits of %s: %.3f to %.3f rad, %.3g rad/s, %.3g rad/s^2\n",
               robot.joints[joint].name.c_str(), limits.position_min_rad, limits.position_max_rad,
               limits.speed_rad_s, limits.acceleration_rad_s2);
}

/// Says where the joint is, twice a second.
JointMover::Progress teller(const RobotConfig& robot, const OperatorCommand& order) {
  return [&robot, order, next_us = std::int64_t{0}](const JointState& state) mutable {
    if (state.stamp.utime_us < next_us) return;
    next_us = state.stamp.utime_us + kTell_us;
    const auto joint = static_cast<std::size_t>(order.joint);
    std::printf("  %s %.4f rad\n", robot.joints[joint].name.c_str(),
                state.joints[joint].estimated_position_rad);
    std::fflush(stdout);
  };
}

int run_move(const MoveRequest& request) {
  const RunInfo info = require_running(request.instance, request.robot);
  const RobotConfig robot = load_robot(info.robot_folder);
  JointMover mover(info, robot);
  OperatorCommand order = order_of(request, robot, mover);
  std::optional<OperatorAnswer> answer = mover.send(order);
  if (!request.as_json) report_motion("move", answer);
  if (went_well(answer) && answer->outcome != OperatorOutcome::kDone && !request.no_wait) {
    answer = mover.follow(order, request.as_json ? JointMover::Progress() : teller(robot, order));
    if (!request.as_json) report_motion("move", answer);
  }
  const double position_rad = look_at(mover, order.joint).estimated_position_rad;
  if (request.as_json) {
    std::printf("%s\n", answer_json(request, order, answer, position_rad).dump(2).c_str());
  } else {
    std::printf("  %s %.4f rad\n", request.joint.c_str(), position_rad);
  }
  if (answer && answer->outcome == OperatorOutcome::kRefused) tell_limits(robot, order);
  return went_well(answer) ? kExitDone : kExitFailed;
}

}  // namespace

void add_move(CommandLine& sprung) {
  const auto request = std::make_shared<MoveRequest>();
  CommandLine& move = sprung.subcommand(
      "move", "Move one joint, hold all others. Switches the drives on; `sprung sit` lets go.");
  move.option("joint", request->joint, "which", Need::kRequired);
  move.option("--to", request->to, "angle, e.g. 0.5rad or 30deg");
  move.option("--by", request->by, "angle from where the joint is now");
  move.option("--speed", request->speed, "e.g. 0.5rad/s; default a tenth of the joint's limit");
  move.option("--acceleration", request->acceleration,
              "e.g. 2rad/s^2; default: the speed is reached in a quarter of a second");
  move.option("--instance", request->instance, "which run");
  move.option("--robot", request->robot, "refuse unless this robot is up");
  move.option("--at", request->at_seq, "cycle in which it shall take effect, -1 = the next");
  move.flag("--no-wait", request->no_wait, "return when it is accepted, not when it is done");
  move.flag("--json", request->as_json, "one JSON object on standard output");
  move.example("sprung move knee --to 1.2rad --speed 30deg/s\n  sprung move hip --by -5deg");
  move.action([=] { return run_move(*request); });
}

}  // namespace sprung::commands
