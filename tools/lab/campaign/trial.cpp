#include "tools/lab/campaign/trial.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "tools/lab/campaign/expected_cause.h"
#include "tools/lab/campaign/link_tamper.h"
#include "tools/lab/faults/fault_motion.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung::campaign {
namespace {

constexpr double kSettleBooted_s = 0.5, kHome_s = 2.0, kStand_s = 6.0;
constexpr double kPartOfARise_s = 0.3, kPartOfASit_s = 0.2, kStopped_s = 0.5;
constexpr double kWatched_s = 2.0;  // after the last injection has ended, and until torque is off
constexpr double kLongestWatched_s = 9.0;
constexpr double kClear_s = 8.0, kStops_s = 8.0;

/// Every cycle of the robot is seen by the judge, and by the tampering before.
class Links : public LinkTamper {
 public:
  Links(const RobotConfig& stack, const RobotConfig& machine, std::uint64_t seed)
      : LinkTamper(stack, seed), judge_(machine) {}
  void sent(const FrameBatch& frames) noexcept override { judge_.sent(frames); }
  void answered(const FrameBatch& frames) noexcept override { judge_.answered(frames); }
  void ordered(const OperatorCommand& command) noexcept override { orders_.push_back(command); }
  Judge& judge() noexcept { return judge_; }
  const std::vector<OperatorCommand>& orders() const noexcept { return orders_; }

 private:
  Judge judge_;
  std::vector<OperatorCommand> orders_;
};

class Trial {
 public:
  Trial(const RobotConfig& robot, const std::string& preset, const Draw& draw)
      : machine_(robot),
        stack_(with_mistake(robot, draw.injections[0])),
        links_(stack_, machine_, draw.sim.seed),
        preset_(preset),
        robot_(stack_, preset, machine_, draw.sim),
        torques_(robot.actuators.size()) {
    verdict_.draw = draw;
    robot_.put_on_links(&links_);
  }

  Verdict run() {
    const bool wrong_file = draw().injections[0].kind == Class::kFile;
    if (wrong_file) begin_watching();
    if (!reach_state_or(wrong_file)) throw std::runtime_error("the robot did not come to " + draw().state);
    advance(draw().wait_s);
    begin_watching();
    inject(0);
    if (draw().injections.size() > 1 && !draw().second_while_clearing) inject(1);
    watch();
    recover();
    finish();
    return verdict_;
  }

  ScriptedTrial script() {
    if (!reach_state()) throw std::runtime_error("the robot did not come to " + draw().state);
    advance(draw().wait_s);
    for (std::size_t i = 0; i < draw().injections.size(); ++i) inject(i);
    watch();
    RunScript out{machine_, preset_, draw().sim, links_.orders(), robot_.cycle() + 1, controls_};
    for (OperatorCommand& order : out.commands) {
      if (order.kind == OperatorKind::kHome) throw std::runtime_error("the robot has to be homed first");
      order.request_id = order.apply_at_seq + 1;
    }
    return {out, robot_.truth()};
  }

 private:
  const Draw& draw() const noexcept { return verdict_.draw; }
  const SafetyState& safety() const { return robot_.bridge().safety(); }
  bool moved_on() const noexcept { return watching_since_ >= 0; }

  void tick() {
    links_.at(seq_ + 1);
    act_on_processes();
    robot_.tick();
    verdict_.simulated_s += machine_.cycle_s;
    if (robot_.sim().failed())
      throw std::runtime_error(std::string("the plant failed: ") + robot_.sim().failure());
    for (int i = 0; i < static_cast<int>(torques_.size()); ++i)
      torques_[static_cast<std::size_t>(i)] = robot_.sim().true_motor_torque_Nm(i);
    if (robot_.sim().cycle() < 0) return;
    ++seq_;
    links_.judge().look({seq_, &robot_.truth(), &torques_, &safety()});
    if (moved_on()) note();
  }
  void advance(double seconds) {
    for (std::int64_t i = std::llround(seconds / machine_.cycle_s); i > 0; --i) tick();
  }
  bool any_torque() const {
    return std::any_of(torques_.begin(), torques_.end(), [](double t) { return t != 0.0; });
  }

  void begin_watching() {
    if (moved_on()) return;
    watching_since_ = seq_;
    begun_s_ = verdict_.simulated_s;
  }
  double since_s() const { return verdict_.simulated_s - begun_s_; }
  void note() {
    // A robot that was being cleared had its operator's own stop.
    const bool own = safety().cause == SafetyCause::kEmergencyStop || safety().cause == SafetyCause::kNone;
    const bool stopped = safety().level != SafetyLevel::kOperational && !own;
    if (stopped && std::isnan(verdict_.noticed_s) && struck_) verdict_.noticed_s = since_s();
    if (stopped && struck_ && verdict_.cause == SafetyCause::kNone && !recovering_)
      verdict_.cause = safety().cause;
    if (struck_) note_force();
    if (struck_ && !recovering_) powered_ = powered_ || links_.judge().any_enabled();
    if (!any_torque() && std::isnan(verdict_.safe_s) && struck_) verdict_.safe_s = since_s();
  }

  void note_force() {
    for (const TrueLeg& leg : robot_.truth().legs) {
      const Vec3& force = leg.true_contact_force_N;
      verdict_.peak_force_N = std::max(verdict_.peak_force_N, std::hypot(force[0], force[1], force[2]));
    }
  }

  OperatorCommand order(OperatorKind kind) {
    links_.judge().operator_asked();
    OperatorCommand command = scripted(kind, robot_.cycle() + 1);
    command.request_id = ++last_request_;
    robot_.submit(command);
    return command;
  }
  /// @return the end of a request, nothing where none came in time.
  std::optional<OperatorReply> end_of(const OperatorCommand& command, double limit_s) {
    for (std::int64_t i = std::llround(limit_s / machine_.cycle_s); i > 0; --i) {
      tick();
      for (OperatorReply reply; robot_.next_reply(reply);)
        if (reply.request_id == command.request_id && reply.outcome != OperatorOutcome::kAccepted &&
            reply.outcome != OperatorOutcome::kQueued)
          return reply;
    }
    return std::nullopt;
  }

  bool all_referenced() const {
    for (int i = 0; i < static_cast<int>(machine_.actuators.size()); ++i)
      if (!robot_.bridge().reference(i).known) return false;
    return true;
  }
  void home() { (void)end_of(order(OperatorKind::kHome), kHome_s); }
  bool stand() {
    if (!machine_.has_feet()) {
      advance(1.0);
      return safety().level == SafetyLevel::kOperational;
    }
    const auto reply = end_of(order(OperatorKind::kStand), kStand_s);
    refusal_ = reply ? reply->reason : "no answer to stand";
    return robot_.motion_state().state == MotionPhase::kStanding;
  }

  /// One whose file is wrong may never get there: it is watched wherever it gets to.
  bool reach_state_or(bool anywhere) {
    try {
      return reach_state() || anywhere;
    } catch (const std::runtime_error&) {
      if (!anywhere || robot_.sim().failed()) throw;
      return true;
    }
  }
  bool reach_state() {
    const std::string& state = draw().state;
    boot();
    advance(kSettleBooted_s);
    if (state == "homing") return begin(OperatorKind::kHome, 0.0);
    if (!all_referenced()) home();
    if (state == "rising") return begin(OperatorKind::kStand, kPartOfARise_s);
    if (!stand()) return false;
    if (state == "sitting") return begin(OperatorKind::kSit, kPartOfASit_s);
    if (state == "clearing") {
      begin(OperatorKind::kEstop, kStopped_s);
      return begin(OperatorKind::kClear, 0.0);
    }
    begin_motion(robot_, stack_, state, draw().sim.seed, [this] { tick(); });
    return true;
  }
  bool begin(OperatorKind kind, double part_s) {
    order(kind);
    advance(part_s);
    return true;
  }
  void boot() {
    for (double t = 0.0; robot_.sim().cycle() < 0 || !robot_.bridge().operational(); t += machine_.cycle_s) {
      if (t > 10.0) throw std::runtime_error(std::string("no boot: ") + robot_.bridge().boot_detail());
      tick();
    }
  }
  void inject(std::size_t i) {
    Injection injection = draw().injections[i];
    if (injection.kind == Class::kDrive || injection.kind == Class::kBus) control(injection);
    injection.at_seq += seq_ + 1;
    struck_ = true;
    links_.add(injection);
    injected_.push_back(injection);
  }
  void control(const Injection& injection) {
    SimControl control;
    control.kind = SimControlKind::kNodeFault;
    control.apply_at_seq = robot_.cycle() + 2 + injection.at_seq;
    control.duration_s = injection.duration_s;
    control.fault = injection.drive_fault;
    control.value = injection.value;
    if (injection.kind == Class::kDrive) {
      control.actuator = injection.target;
      return make(control);
    }
    const int buses = static_cast<int>(machine_.buses.size());
    for (int k = 0; k < (injection.half_of_buses ? buses / 2 : 1); ++k) {
      control.bus = (injection.target + k) % buses;
      make(control);
    }
  }
  void make(const SimControl& control) {
    controls_.push_back(control);
    robot_.sim().control(control);
  }
  void act_on_processes() {
    for (const Injection& injection : injected_) {
      if (injection.kind != Class::kProcess) continue;
      const bool busy = injection.process_fault == ProcessFault::kBusy;
      const bool its_turn = busy && (seq_ + 1) % static_cast<std::int64_t>(injection.value) == 0;
      robot_.stop(injection.process, injection.active(seq_ + 1, machine_.cycle_s) && !its_turn);
    }
  }

  void watch() {
    double least_s = kWatched_s;
    for (const Injection& one : injected_) least_s = std::max(least_s, kWatched_s + one.duration_s);
    const double from_s = verdict_.simulated_s;
    while (verdict_.simulated_s - from_s < kLongestWatched_s) {
      tick();
      const bool at_rest = safety().level == SafetyLevel::kOperational || !any_torque();
      if (verdict_.simulated_s - from_s > least_s && at_rest) break;
    }
  }

  bool dead_process() const {
    return std::any_of(injected_.begin(), injected_.end(), [](const Injection& one) {
      return one.kind == Class::kProcess && one.process_fault == ProcessFault::kKilled;
    });
  }
  void recover() {
    recovering_ = true;
    if (dead_process()) {
      verdict_.explained = "a program is gone";
      return;
    }
    let_it_end();
    const OperatorCommand clear = order(OperatorKind::kClear);
    if (verdict_.draw.injections.size() > 1 && draw().second_while_clearing) inject(1);
    const auto reply = end_of(clear, kClear_s);
    if (!reply || reply->outcome != OperatorOutcome::kDone) {
      verdict_.explained = reply ? reply->reason : dead_process() ? "a program is gone" : "";
      return;
    }
    if (!all_referenced()) home();
    verdict_.recovered = stand() && safety().level == SafetyLevel::kOperational;
    if (verdict_.recovered) return;
    const char* const detail = safety().detail.data();
    verdict_.explained = *detail != 0 ? detail : refusal_;
  }

  /// What still moves is told to stop, and a jump ends by itself.
  void let_it_end() {
    if (!machine_.has_feet() || safety().level != SafetyLevel::kOperational) return;
    order(OperatorKind::kStop);
    for (double t = 0.0; t < kStops_s && !at_rest(robot_.motion_state().state); t += machine_.cycle_s) tick();
  }
  static bool at_rest(MotionPhase state) noexcept {
    return state == MotionPhase::kStanding || state == MotionPhase::kIdle || state == MotionPhase::kFallen;
  }

  void finish() {
    const Judge& judge = links_.judge();
    for (const Breach& breach : judge.breaches()) {
      // By a wrong file every set-point is somewhere else than meant: what joints do counts then.
      if (draw().injections[0].kind == Class::kFile && breach.rule == Rule::kBadSetpoint) continue;
      verdict_.breaches.push_back(breach);
    }
    verdict_.fastest_share = judge.fastest_share();
    verdict_.farthest_rad = judge.farthest_beyond_rad();
    verdict_.damping_work_J = judge.damping_work_J();
    verdict_.cause_expected = std::any_of(injected_.begin(), injected_.end(), [&](const Injection& one) {
      return cause_is_expected(one, verdict_.cause, powered_);
    });
  }

  const RobotConfig machine_, stack_;
  Links links_;
  const std::string preset_;
  InProcessRobot robot_;
  std::vector<double> torques_;
  std::vector<Injection> injected_;
  std::vector<SimControl> controls_;
  Verdict verdict_;
  std::int64_t seq_ = -1, watching_since_ = -1, last_request_ = 1000;
  double begun_s_ = 0.0;
  bool struck_ = false, recovering_ = false;
  bool powered_ = false;  ///< any drive, since something went wrong
  std::string refusal_;
};

}  // namespace

bool has_script(const Draw& draw) noexcept {
  const bool asks_the_bridge = draw.state == "clearing" || draw.state == "homing";
  return !asks_the_bridge && !draw.second_while_clearing &&
         std::all_of(draw.injections.begin(), draw.injections.end(), [](const Injection& one) {
           return one.kind == Class::kDrive || one.kind == Class::kBus;
         });
}

ScriptedTrial script_of(const RobotConfig& robot, const std::string& preset, const Draw& draw) {
  if (!has_script(draw)) throw std::invalid_argument("no script holds this run");
  return Trial(robot, preset, draw).script();
}

namespace {

/// @return why no process begins with this wrong file, though no check has seen it; "" where one does.
std::string refused_at_start(const RobotConfig& robot, const std::string& preset, const Draw& draw) {
  if (draw.injections[0].kind != Class::kFile) return "";
  try {
    const InProcessRobot begins(with_mistake(robot, draw.injections[0]), preset, robot, draw.sim);
    return "";
  } catch (const std::invalid_argument& refusal) {
    return refusal.what();
  }
}

}  // namespace

Verdict run_trial(const RobotConfig& robot, const std::string& preset, const Draw& draw) {
  try {
    const std::string refusal = refused_at_start(robot, preset, draw);
    if (refusal.empty()) return Trial(robot, preset, draw).run();
    Verdict verdict;
    verdict.draw = draw;
    verdict.explained = refusal;
    return verdict;
  } catch (const std::exception& error) {
    Verdict verdict;
    verdict.draw = draw;
    verdict.failure = error.what();
    return verdict;
  }
}

}  // namespace sprung::campaign
