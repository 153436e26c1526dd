#include "tools/lab/friction/drag.h"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tools/lab/friction/drag_report.h"
#include "tools/lab/friction/friction_sweep.h"

namespace sprung {
namespace {

constexpr double kDragRest_s = 0.5;
constexpr double kDamped_s = 1.5;  // sitting down from a held joint: damped, then off
constexpr double kFirstMove_rad = 0.05;
constexpr double kSpeed_rad_s = 0.5;
constexpr double kDragAcceleration_rad_s2 = 10.0;
constexpr double kDragSenseOfRated = 0.6;
/// The sweep that finds friction must not be the run that is scored.
constexpr std::uint64_t kSweepSeedOffset = 1000;

class DragRun {
 public:
  DragRun(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int joint)
      : bench_(robot, preset, sim, joint), limits_(bench_limits(robot, joint)) {
    bench_.home();
    result_.sensed = bench_.robot().sim().torque_sensor().joint == joint;
  }

  DragResult run(const std::vector<DragPhase>& phases) {
    find_sense();
    for (const DragPhase& phase : phases) {
      supply(phase.drive_on);
      play(phase);
    }
    result_.simulated_s = bench_.time_s();
    std::vector<DragSample> all;
    for (const DragPhaseResult& phase : result_.phases)
      all.insert(all.end(), phase.samples.begin(), phase.samples.end());
    result_.all = drag_score(all);
    return result_;
  }

 private:
  /// In the middle of the range, where the drive's stiffness shows which way the hand pushes.
  void find_sense() {
    bench_.move(0.5 * (limits_.position_min_rad + limits_.position_max_rad) + kFirstMove_rad, kSpeed_rad_s,
                kDragAcceleration_rad_s2);
    bench_.find_load_sense(kDragSenseOfRated * limits_.rated_torque_Nm);
    powered_ = true;
  }

  void supply(bool on) {
    if (on == powered_) return;
    if (on) {
      bench_.move(bench_.sample().position_rad, kSpeed_rad_s, kDragAcceleration_rad_s2);
    } else {
      bench_.sit();
      bench_.run(kDamped_s);
    }
    powered_ = on;
    bench_.run(kDragRest_s);
  }

  void play(const DragPhase& phase) {
    began_s_ = bench_.time_s();
    start_rad_ = bench_.truth().true_position_rad;
    before_ = now();
    readings_ = bench_.robot().sim().torque_reading_count();
    result_.phases.push_back({phase.name, began_s_, 0.0, {}, {}});
    const auto observe = [&](JointBench&) { step(phase); };
    const double from_rad = bench_.sample().position_rad;
    for (const double to_rad : phase.moves_rad)
      bench_.move(from_rad + to_rad, phase.move_speed_rad_s, kDragAcceleration_rad_s2, observe);
    bench_.run(phase.duration_s, observe);
    bench_.load(0.0);
    DragPhaseResult& done = result_.phases.back();
    done.to_s = bench_.time_s();
    done.score = drag_score(done.samples);
    bench_.run(kDragRest_s);
  }

  void step(const DragPhase& phase) {
    score();
    const bool held = phase.grip.stiffness_Nm_rad > 0.0;
    const HandPoint hand = hand_at(phase, bench_.time_s() - began_s_);
    const TrueJoint& link = bench_.truth();
    const double torque_Nm = held ? hand_torque_Nm(phase.grip, hand, link.true_position_rad - start_rad_,
                                                   link.true_velocity_rad_s)
                                  : 0.0;
    if (held) bench_.load(torque_Nm, bench_.cycle_s());
    DragTrace& trace = result_.trace;
    trace.time_s.push_back(bench_.time_s());
    trace.angle_rad.push_back(bench_.estimate().estimated_position_rad);
    trace.hand_angle_rad.push_back(held ? start_rad_ + hand.angle_rad : kNaN);
    trace.hand_torque_Nm.push_back(torque_Nm);
  }

  DragSample now() {
    const EstimatedJoint& e = bench_.estimate();
    return {bench_.time_s(), bench_.truth().true_gear_output_torque_Nm, e.gear_output_torque_Nm,
            e.gear_output_torque_bound_Nm, e.motor_side_torque_Nm};
  }

  /// Every reading of the sensor at its own time; without a sensor the truth of every cycle.
  void score() {
    const DragSample sample = now();
    std::vector<DragSample>& out = result_.phases.back().samples;
    if (!result_.sensed) {
      out.push_back(sample);
    } else {
      const SimCore& sim = bench_.robot().sim();
      for (; readings_ < sim.torque_reading_count(); ++readings_) {
        const TorqueSensor& reading = sim.torque_reading(readings_);
        const double time_s = 1e-6 * static_cast<double>(reading.stamp.utime_us);
        if (time_s > sample.time_s) break;
        out.push_back(between(before_, sample, time_s));
        out.back().reference_Nm = reading.measured_torque_Nm;
      }
    }
    before_ = sample;
  }

  JointBench bench_;
  BenchLimits limits_;
  DragResult result_;
  DragSample before_;
  bool powered_ = false;
  double began_s_ = 0.0;
  double start_rad_ = 0.0;
  std::int64_t readings_ = 0;
};

/// Moved by its motor against a hand: what friction owes to the load shows there most.
constexpr const char* kAgainstHand = "moved_against_hand";
constexpr double kMostAgainstHand_Nm = 2.5;

void add_rows(const DragScore& score, const std::string& prefix, const Bounds& rms_Nm,
              std::vector<ReportRow>& rows) {
  const auto add = [&](const char* quantity, const char* unit, double value, const Bounds& bounds = {}) {
    rows.push_back(row(prefix + quantity, unit, value, bounds));
  };
  add("rms", "Nm", score.rms_Nm, rms_Nm);
  add("max", "Nm", score.max_Nm);
  add("coverage", "", score.coverage);
  add("half_width", "Nm", score.half_width_Nm);
  add("paper_rms", "Nm", score.paper_rms_Nm);
}

std::string friction_text(const JointConfig& joint) {
  if (!joint.friction) return "not identified; the paper's: " + joint.friction_source;
  return std::string("identified, model ") + name(joint.friction->model) + ", " + joint.friction->record.log;
}

}  // namespace

DragResult run_drag(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int joint) {
  DragResult out = DragRun(robot, preset, sim, joint).run(drag_script(robot.joints.size() == 1));
  const JointConfig& config = robot.joints[joint];
  out.robot = robot.name;
  out.joint = config.name;
  out.seed = sim.seed;
  out.friction = friction_text(config);
  return out;
}

RobotConfig with_swept_friction(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                int joint) {
  SimOptions other = sim;
  other.seed = sim.seed + kSweepSeedOffset;
  const SweepResult sweep = run_friction_sweep(robot, preset, other, joint, SweepProtocol::kLoaded);
  const SweepFit& best = sweep.fits.back();
  IdentifiedFriction found;
  found.model = FrictionModelKind::kLoad;
  found.parameters = best.model->friction(best.fit.parameters);
  found.record.log = "loaded sweep of seed " + std::to_string(other.seed);
  found.record.samples = best.score.samples;
  found.record.held_out_r2 = best.held_out.r2;
  found.record.held_out_rms_Nm = best.held_out.rms;
  found.record.command = "sprung experiment friction_sweep --robot " + robot.name +
                         " --protocol loaded --seed " + std::to_string(other.seed);
  RobotConfig out = robot;
  out.joints[joint].friction = found;
  return out;
}

std::vector<ReportRow> drag_rows(const DragResult& result, const std::string& prefix) {
  std::vector<ReportRow> out;
  for (const DragPhaseResult& phase : result.phases)
    add_rows(phase.score, prefix + "." + phase.name + ".",
             demanded(phase.name == kAgainstHand, at_most(kMostAgainstHand_Nm)), out);
  add_rows(result.all, prefix + ".all.", {}, out);
  return out;
}

namespace {

void add_drag(const DragResult& result, const std::string& prefix, ExperimentOutput& out) {
  for (const ReportRow& row : drag_rows(result, prefix)) out.rows.push_back(row);
  out.simulated_s += result.simulated_s;
  out.sections.push_back(drag_section(result));
  out.before += drag_table(result);
}

}  // namespace

Experiment drag_experiment() {
  struct Own {
    std::string joint, friction = "yaml";
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "drag";
  out.what =
      "The link is moved from outside: torque estimate against torque sensor, or truth where there is none.";
  out.question =
      "How near is the estimated torque, and does it stay within its bound, when the gear is driven?";
  out.robot = "test_axis";
  out.robot_help = "test_axis, pegasus, or a folder";
  out.takes = {Common::kPlant, Common::kReport};
  out.in_all = {RobotKind::kJoint};
  out.example = "--robot test_axis --friction both --report drag.html";
  out.own.option("--joint", own->joint, "by name; default: the bench's arm, or the first knee");
  out.own.choice(
      "--friction", own->friction, {"yaml", "sweep", "both"},
      "that the estimator knows: robot.yaml's, or what a loaded friction sweep of another seed finds");
  out.run = [own](const ExperimentInput& in) {
    const int joint = bench_joint(in.robot, own->joint);
    ExperimentOutput output;
    if (own->friction != "sweep") add_drag(run_drag(in.robot, in.preset, in.sim, joint), "drag", output);
    if (own->friction == "yaml") return output;
    const RobotConfig swept = with_swept_friction(in.robot, in.preset, in.sim, joint);
    add_drag(run_drag(swept, in.preset, in.sim, joint), "drag_swept", output);
    return output;
  };
  return out;
}

}  // namespace sprung
