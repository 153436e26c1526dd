#include "tools/lab/faults/fault_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "tools/lab/run/scripted_run.h"

namespace sprung {
namespace {

constexpr double kWalk_s = 2.0;
constexpr double kComply_s = 1.0;
constexpr double kJump_s = 3.0;       // a crouch and its settling come first
constexpr double kSpeedShare = 0.65;  // of the gait's fastest forward

constexpr std::array<std::pair<const char*, MotionPhase>, 4> kJumpPhases{
    {{"crouch", MotionPhase::kCrouch},
     {"thrust", MotionPhase::kThrust},
     {"flight", MotionPhase::kFlight},
     {"landing", MotionPhase::kLanding}}};

bool jumps(const RobotConfig& robot) { return robot.preset().jumps(); }

class Beginning {
 public:
  Beginning(InProcessRobot& robot, const RobotConfig& config, const std::function<void()>& tick)
      : robot_(robot), config_(config), tick_(tick) {}

  void walk(std::size_t gait, std::uint64_t seed) {
    const GaitConfig& wanted = config_.gaits[gait];
    OperatorCommand order = scripted(OperatorKind::kWalk, robot_.cycle() + 1);
    order.gait = static_cast<int>(gait);
    order.walk_speed = {kSpeedShare * wanted.fastest_forward_m_s, 0.0, 0.0};
    std::mt19937_64 random(seed);
    const double part_s = std::uniform_real_distribution<>(0.0, wanted.period_s)(random);
    ask(order, MotionPhase::kWalking, 1.0);
    advance(kWalk_s + part_s);
  }
  void comply() {
    ask(scripted(OperatorKind::kComply, robot_.cycle() + 1), MotionPhase::kComplying, 1.0);
    advance(kComply_s);
  }
  void jump(MotionPhase phase) { ask(scripted(OperatorKind::kJump, robot_.cycle() + 1), phase, kJump_s); }

 private:
  void advance(double seconds) {
    for (std::int64_t i = std::llround(seconds / config_.cycle_s); i > 0; --i) tick();
  }
  void tick() {
    if (tick_) return tick_();
    robot_.tick();
  }
  void ask(const OperatorCommand& order, MotionPhase phase, double limit_s) {
    robot_.submit(order);
    for (std::int64_t i = std::llround(limit_s / config_.cycle_s); i > 0; --i) {
      tick();
      if (robot_.motion_state().state == phase) return;
      for (OperatorReply reply; robot_.next_reply(reply);)
        if (reply.request_id == order.request_id && reply.outcome == OperatorOutcome::kRefused)
          throw std::runtime_error(std::string("the motion was refused: ") + reply.reason);
    }
    throw std::runtime_error(std::string("the robot never came to ") + name(phase));
  }

  InProcessRobot& robot_;
  const RobotConfig& config_;
  const std::function<void()>& tick_;
};

}  // namespace

std::vector<std::string> fault_motions(const RobotConfig& robot) {
  std::vector<std::string> out{kNoMotion};
  if (!robot.has_feet()) return out;
  out.emplace_back("comply");
  for (const GaitConfig& gait : robot.gaits)
    if (gait.duty < 1.0) out.push_back(gait.name);
  if (jumps(robot))
    for (const auto& phase : kJumpPhases) out.emplace_back(phase.first);
  return out;
}

void begin_motion(InProcessRobot& robot, const RobotConfig& config, const std::string& motion,
                  std::uint64_t seed, const std::function<void()>& tick) {
  Beginning begin(robot, config, tick);
  if (motion == kNoMotion) return;
  if (motion == "comply") return begin.comply();
  for (std::size_t i = 0; i < config.gaits.size(); ++i)
    if (config.gaits[i].duty < 1.0 && config.gaits[i].name == motion) return begin.walk(i, seed);
  for (const auto& phase : kJumpPhases)
    if (jumps(config) && motion == phase.first) return begin.jump(phase.second);
  std::string known;
  for (const std::string& one : fault_motions(config)) known += (known.empty() ? "" : ", ") + one;
  throw std::invalid_argument("no motion '" + motion + "' of this robot; there are: " + known);
}

}  // namespace sprung
