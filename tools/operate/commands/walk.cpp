#include <memory>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "tools/commands.h"
#include "tools/operate/client/gait_choice.h"
#include "tools/operate/commands/held_motion.h"

namespace sprung::commands {

namespace {

constexpr double kListen_s = 0.5;  // for MOTION_STATE, which comes every cycle

struct WalkWish : HeldCall {
  GaitWish gait;
  double height_m = kNaN;
  double width_m = kNaN;
  std::string control = name(GaitControl::kAdaptive);
};

/// The gait that the robot walks in; -1: it does not walk, or nobody says so.
int walking_in(const RunInfo& info, const RobotConfig& robot) {
  InputQueue<sprung_msgs::motion_state_t> motions(64);
  Node node({info.lcm_url, info.session, info.epoch_us, {}});
  node.subscribe_message(channels::kMotionState, CountLimits::exactly(robot.legs.size()), motions);
  node.start();
  const std::int64_t end_us = node.utime_us() + static_cast<std::int64_t>(1e6 * kListen_s);
  while (node.utime_us() < end_us) {
    node.wait_for_input(end_us);
    if (const auto motion = motions.pop())
      return static_cast<MotionPhase>(motion->state) == MotionPhase::kWalking ? motion->gait : -1;
  }
  return -1;
}

GaitChoice choice(const WalkWish& wish) {
  const RunInfo info = require_running(wish.instance, wish.robot);
  const RobotConfig robot = load_robot(info.robot_folder);
  const bool open = wish.gait.gait.empty() && !robot.gaits.empty();
  try {
    return choose_gait(robot, wish.gait, open ? walking_in(info, robot) : -1);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

int run_walk(const WalkWish& wish) {
  const GaitChoice chosen = choice(wish);
  OperatorCommand order;
  order.kind = OperatorKind::kWalk;
  order.gait = chosen.gait;
  order.walk_speed = chosen.speed;
  order.body_height_m = wish.height_m;
  order.stance_width_m = wish.width_m;
  order.gait_control = value_named<GaitControl>(wish.control).value();
  return run_held("walk", order, wish);
}

}  // namespace

void add_walk(CommandLine& sprung) {
  const auto wish = std::make_shared<WalkWish>();
  CommandLine& walk = sprung.subcommand("walk",
                                        "Walk while this command runs, or --for a time; the robot must "
                                        "stand. From another terminal while it walks: "
                                        "another speed or gait.");
  walk.option("--gait", wish->gait.gait,
              "one of robot.yaml's; default: the one it walks in, else the fastest that can go that speed");
  walk.option("--speed", wish->gait.forward_m_s,
              "m/s forward; default: two thirds of the gait's fastest, or 0 beside --sideways or --turn");
  walk.option("--sideways", wish->gait.left_m_s, "m/s to the left; default: 0");
  walk.option("--turn", wish->gait.turning_rad_s, "rad/s to the left; default: 0");
  walk.option("--height", wish->height_m, "m, hips over feet; default: the gait's, else the preset's");
  walk.option("--width", wish->width_m, "m by which each foot stands further out; default: the preset's");
  walk.choice("--control", wish->control, names_of<GaitControl>(),
              "of swinging legs: position with a slow approach of sprung's own, or with the papers' soft "
              "pre-stance, or without; or virtual springs throughout");
  add_held_call(walk, *wish);
  walk.example(
      "sprung walk --speed 0.3; sprung walk --speed 0.2 --turn 0.3 --for 10; "
      "sprung walk --gait crawl --speed 0.1 --for 20; sprung stop");
  walk.action([=] { return run_walk(*wish); });
}

}  // namespace sprung::commands
