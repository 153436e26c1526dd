#include "tools/lab/faults/fault_experiment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>

#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/faults/fault_counters.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

namespace {

constexpr double kSettleBooted_s = 0.1;  // the estimator's, after booting
constexpr double kStand_s = 4.0;         // to rise and to stand quietly; the drives enable on the way
constexpr double kPowerOn_s = 1.0;       // faults from power-on are reset
constexpr double kHomeAgain_s = 2.0;
constexpr double kAfterFault_s = 1.5;      // quick stop included
constexpr double kAfterMovingFault_s = 6;  // damping lasts until the joints rest, 5 s at most
constexpr double kClear_s = 8.0;

/// A robot that could fall hangs in the air: what a fault does to it, not what the floor does then.
SimOptions held_up(const RobotConfig& robot, SimOptions sim) {
  constexpr double kHeight_m = 0.8;
  if (robot.body.mass_kg > 0.0) sim.plant["suspended"] = kHeight_m;
  return sim;
}

/// One fault on one robot, from booting to standing again.
class FaultRun {
 public:
  FaultRun(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, const FaultCase& fault,
           const std::string& motion)
      : config_(robot),
        fault_(fault),
        seed_(sim.seed),
        robot_(robot, preset, motion == kNoMotion ? held_up(robot, sim) : sim) {
    outcome_.fault = fault;
    outcome_.motion = motion;
    const ActuatorConfig& last = robot.actuators.back();
    outcome_.target = fault.on_bus ? robot.buses[last.bus].name : last.name;
  }

  FaultOutcome run() {
    robot_.boot(10.0);
    advance(kSettleBooted_s);
    if (!all_referenced()) home();
    if (!stand()) throw std::runtime_error("the robot did not stand up before the fault");
    begin_motion(robot_, config_, outcome_.motion, seed_);
    strike();
    clear();
    outcome_.homed_again = !all_referenced() && home();
    outcome_.referenced = all_referenced();
    outcome_.back = outcome_.cleared && stand() && outcome_.referenced;
    return outcome_;
  }

 private:
  void tick() {
    robot_.tick();
    if (robot_.sim().failed())
      throw std::runtime_error(std::string("the simulated plant failed: ") + robot_.sim().failure());
  }
  void advance(double seconds) {
    for (std::int64_t i = std::llround(seconds / config_.cycle_s); i > 0; --i) tick();
  }
  std::int64_t submit(OperatorKind kind) {
    OperatorCommand command = scripted(kind, robot_.cycle() + 1);
    robot_.submit(command);
    return command.request_id;
  }
  bool operational() const { return robot_.bridge().safety().level == SafetyLevel::kOperational; }
  bool all_referenced() const {
    bool all = true;
    for (int i = 0; i < static_cast<int>(config_.actuators.size()); ++i)
      all = all && robot_.bridge().reference(i).known;
    return all;
  }
  /// As robot.yaml says for each actuator. @return false where it says nothing.
  bool home() {
    const std::int64_t id = submit(OperatorKind::kHome);
    for (std::int64_t i = std::llround(kHomeAgain_s / config_.cycle_s); i > 0; --i) {
      for (OperatorReply reply; robot_.next_reply(reply);) {
        if (reply.request_id == id && reply.outcome != OperatorOutcome::kAccepted)
          return reply.outcome == OperatorOutcome::kDone;
      }
      tick();
    }
    return false;
  }
  /// Stands; a robot that has nothing to stand on is as far as it gets when safety lets it move.
  bool stand() {
    if (!config_.has_feet()) {
      advance(kPowerOn_s);
      return operational();
    }
    submit(OperatorKind::kStand);
    advance(kStand_s);
    return operational() && robot_.motion_state().state == MotionPhase::kStanding;
  }

  void strike() {
    const BusState before = robot_.bridge().bus_state();
    const std::int64_t start = robot_.cycle() + 2;
    SimControl control;
    control.kind = SimControlKind::kNodeFault;
    control.apply_at_seq = start;
    control.duration_s = fault_.duration_s;
    control.fault = fault_.kind;
    control.value = fault_.value;
    if (fault_.on_bus) {
      control.bus = config_.actuators.back().bus;
    } else {
      control.actuator = static_cast<std::int32_t>(config_.actuators.size()) - 1;
    }
    robot_.sim().control(control);
    const std::int64_t count = trouble_count(before);
    had_torque_ = any_torque();
    const double after_s = outcome_.motion == kNoMotion ? kAfterFault_s : kAfterMovingFault_s;
    for (std::int64_t i = std::llround((fault_.duration_s + after_s) / config_.cycle_s); i > 0; --i) {
      tick();
      watch(config_.cycle_s * static_cast<double>(robot_.cycle() - start), count);
    }
    outcome_.counted = grown_counters(before, robot_.bridge().bus_state());
  }

  void watch(double since_s, std::int64_t count_before) {
    const SafetyState& safety = robot_.bridge().safety();
    const bool reacted = safety.level != SafetyLevel::kOperational;
    const bool counted = fault_.cause == SafetyCause::kNone &&
                         trouble_count(robot_.bridge().bus_state()) > count_before;
    if (std::isnan(outcome_.detected_s) && (reacted || counted)) outcome_.detected_s = since_s;
    if (reacted && outcome_.cause == SafetyCause::kNone) outcome_.cause = safety.cause;
    if (severity(safety.level) > severity(outcome_.worst)) outcome_.worst = safety.level;
    if (any_torque()) {
      outcome_.torque_off_s = kNaN;
    } else if (had_torque_ && std::isnan(outcome_.torque_off_s)) {
      outcome_.torque_off_s = since_s;
    }
  }

  bool any_torque() {
    for (int i = 0; i < static_cast<int>(config_.actuators.size()); ++i) {
      if (robot_.sim().true_motor_torque_Nm(i) != 0.0) return true;
    }
    return false;
  }

  void clear() {
    const std::int64_t id = submit(OperatorKind::kClear);
    const std::int64_t start = robot_.cycle();
    for (std::int64_t i = std::llround(kClear_s / config_.cycle_s); i > 0; --i) {
      tick();
      for (OperatorReply reply; robot_.next_reply(reply);) {
        if (reply.request_id == id && reply.outcome != OperatorOutcome::kAccepted)
          return finish_clear(reply, start);
      }
    }
    outcome_.recovery = "no end of the clear in " + std::to_string(static_cast<int>(kClear_s)) + " s";
  }

  void finish_clear(const OperatorReply& reply, std::int64_t start) {
    outcome_.cleared = reply.outcome == OperatorOutcome::kDone;
    outcome_.clear_s = config_.cycle_s * static_cast<double>(robot_.cycle() - start);
    const NodeHealth& node = robot_.bridge().bus_state().nodes[config_.actuators.size() - 1];
    outcome_.recovery = outcome_.cleared ? node.recovery.data() : reply.reason;
  }

  const RobotConfig& config_;
  const FaultCase& fault_;
  std::uint64_t seed_;
  InProcessRobot robot_;
  FaultOutcome outcome_;
  bool had_torque_ = false;
};

std::string case_name(const FaultOutcome& outcome) {
  std::string text = name(outcome.fault.kind);
  if (outcome.fault.kind == FaultKind::kFramesLost && outcome.fault.value < 1.0) text += "-some";
  return text;
}

std::string milliseconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f ms", 1e3 * seconds);
  return std::isfinite(seconds) ? text : "-";
}

/// A flipped bit may be the status word's own fault bit: then the drive is believed.
bool cause_as_expected(const FaultOutcome& outcome) {
  const bool believed = outcome.fault.kind == FaultKind::kFramesFlipped &&
                        outcome.cause == SafetyCause::kDriveFault;
  // Standing hides what moving shows.
  const bool shown = outcome.motion != kNoMotion && outcome.fault.cause == SafetyCause::kNone &&
                     outcome.cause == SafetyCause::kImplausible;
  return believed || shown || outcome.cause == outcome.fault.cause;
}

std::vector<FaultOutcome> run_faults(const ExperimentInput& in, const std::string& only,
                                     const std::string& motion) {
  std::vector<FaultCase> cases;
  for (const FaultCase& fault : fault_cases(in.robot)) {
    if (only.empty() || only == name(fault.kind)) cases.push_back(fault);
  }
  if (cases.empty()) throw std::invalid_argument("no fault '" + only + "'; see sprung fault --help");
  std::vector<FaultOutcome> outcomes;
  for (const FaultCase& fault : cases) {
    if (in.parallel.on_progress) in.parallel.on_progress(outcomes.size(), cases.size());
    outcomes.push_back(run_fault(in.robot, in.preset, in.sim, fault, motion));
  }
  return outcomes;
}

}  // namespace

FaultOutcome run_fault(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                       const FaultCase& fault, const std::string& motion) {
  return FaultRun(robot, preset, sim, fault, motion).run();
}

std::vector<ReportRow> fault_rows(const std::vector<FaultOutcome>& outcomes) {
  std::vector<ReportRow> rows;
  for (const FaultOutcome& outcome : outcomes) {
    const std::string prefix = "faults." + case_name(outcome) + ".";
    const double reached = cause_as_expected(outcome) ? 1.0 : 0.0;
    const double expected_back = outcome.fault.back ? 1.0 : 0.0;
    rows.push_back(row(prefix + "detection", "ms", 1e3 * outcome.detected_s,
                       demanded(!std::isnan(outcome.fault.within_s), at_most(1e3 * outcome.fault.within_s))));
    rows.push_back(row(prefix + "cause_as_expected", "", reached, between(1.0, 1.0)));
    rows.push_back(row(prefix + "torque_off", "ms", 1e3 * outcome.torque_off_s));
    // One that fell may lie on its back.
    rows.push_back(row(prefix + "back_after_clear", "", outcome.back ? 1.0 : 0.0,
                       demanded(outcome.motion == kNoMotion, between(expected_back, expected_back))));
  }
  return rows;
}

std::string fault_table(const std::vector<FaultOutcome>& outcomes) {
  std::string text =
      "| fault | on | noticed after | cause named | worst level | no torque after | counted | `sprung clear` "
      "did | back |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const FaultOutcome& o : outcomes) {
    const bool reacted = o.worst != SafetyLevel::kOperational;
    text += "| " + case_name(o) + " | " + o.target + " | " + milliseconds_text(o.detected_s) + " | " +
            (reacted             ? name(o.cause)
             : o.counted.empty() ? "none: not seen on the bus"
                                 : "none: counted only") +
            " | " + name(o.worst) + " | " + milliseconds_text(reacted ? o.torque_off_s : kNaN) + " | " +
            o.counted + " | " + o.recovery + " | " +
            (o.back          ? (o.homed_again ? "yes, with `sprung home`" : "yes")
             : !o.referenced ? "no: not referenced"
                             : "no") +
            " |\n";
  }
  return text;
}

Experiment faults_experiment() {
  struct Own {
    std::string only, motion = kNoMotion;
    bool markdown = false;
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "faults";
  out.what =
      "Every fault on the simulated robot: when it is noticed, what follows, whether clear brings the robot "
      "back.";
  out.question = "Is every fault noticed in time and named, and does the robot come back without a restart?";
  out.takes = {Common::kPreset, Common::kPlant, Common::kOut};
  out.example = "--robot single_leg --seed 1 --markdown";
  out.own.option("--only", own->only, "one kind of fault, e.g. bus-off");
  out.own.option("--while", own->motion,
                 "what the robot does then: standing, comply, a gait, or crouch, thrust, flight, landing");
  out.own.flag("--markdown", own->markdown, "the table of docs/drivers.md");
  out.run = [own](const ExperimentInput& in) {
    const std::vector<FaultOutcome> outcomes = run_faults(in, own->only, own->motion);
    ExperimentOutput output{fault_rows(outcomes)};
    if (own->markdown) output.instead = fault_table(outcomes);
    return output;
  };
  return out;
}

}  // namespace sprung
