#include "tools/lab/estimation/walking_estimate.h"

#include <stdexcept>

#include "signals/quantile.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/gait/legged_trial.h"

namespace sprung {

namespace {

constexpr double kWalkingDelay_ms = 10.0;
constexpr double kLeastCovered = 0.93, kMostCovered = 0.985;  // as of a leg's bounds
constexpr double kMostHalfWidthOverRms = 2.6;

/// A step begins where the planner lifts the foot.
class WalkScorer {
 public:
  explicit WalkScorer(const RobotConfig& robot) : robot_(robot), last_(robot.legs.size(), LegPhase::kIdle) {
    for (std::size_t leg = 0; leg < last_.size(); ++leg) contacts_.emplace_back(leg);
  }

  void add(const InProcessRobot& process) {
    for (std::size_t leg = 0; leg < contacts_.size(); ++leg) {
      const LegPhase phase = process.motion_state().legs[leg].phase;
      if (phase == LegPhase::kSwing && last_[leg] != LegPhase::kSwing) contacts_[leg].begin_step();
      last_[leg] = phase;
      contacts_[leg].add(process.joint_state(), process.truth());
      add_torques(leg, phase == LegPhase::kSwing ? found_.swing : found_.stance, process);
    }
  }
  WalkingEstimate finish() {
    for (ContactScorer& contact : contacts_) {
      const std::vector<ContactStep>& more = contact.finish();
      found_.steps.insert(found_.steps.end(), more.begin(), more.end());
    }
    return found_;
  }

 private:
  void add_torques(std::size_t leg, TorqueScore& score, const InProcessRobot& process) {
    for (const int joint : robot_.legs[leg].joints) {
      const EstimatedJoint& estimated = process.joint_state().joints[static_cast<std::size_t>(joint)];
      score.add(estimated, process.truth().joints[static_cast<std::size_t>(joint)]);
      found_.fits = found_.fits && estimated.model_fits;
    }
  }

  const RobotConfig& robot_;
  std::vector<LegPhase> last_;
  std::vector<ContactScorer> contacts_;
  WalkingEstimate found_;
};

}  // namespace

void WalkingEstimate::add(const WalkingEstimate& other) {
  steps.insert(steps.end(), other.steps.begin(), other.steps.end());
  stance.add(other.stance);
  swing.add(other.swing);
  fits = fits && other.fits;
}

WalkingEstimate walking_estimate(const RobotConfig& robot, const WalkingEstimateRequest& request) {
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = gait_index(robot, request.gait);
  walk.walk_speed = {request.forward_m_s, 0.0, 0.0};
  LeggedTrial trial(robot, request.preset, lying(request.sim));
  trial.stand_up();
  trial.say(walk);
  WalkScorer scorer(robot);
  trial.run(request.walking_s, [&](InProcessRobot& process) { scorer.add(process); });
  if (trial.robot().motion_state().state != MotionPhase::kWalking)
    throw std::runtime_error("the robot does not walk to the end");
  return scorer.finish();
}

std::vector<ReportRow> walking_estimate_rows(const std::string& gait, const WalkingEstimate& found) {
  const ContactCounts counts(found.steps);
  std::vector<double> delays_ms;
  for (const ContactStep& step : found.steps) {
    if (step.delay_ms) delays_ms.push_back(*step.delay_ms);
  }
  TorqueScore all = found.stance;
  all.add(found.swing);
  const std::string contact = "estimator.contact." + gait, walk = "estimator.walk." + gait;
  return {row(contact + ".found", "%", counts.found_percent(), at_least(kLeastContactFound_percent)),
          row(contact + ".delay_median", "ms", quantile(delays_ms, 0.5), at_most(kWalkingDelay_ms)),
          row(contact + ".delay_p95", "ms", quantile(delays_ms, 0.95), at_most(kWalkingDelay_ms)),
          row(contact + ".false_alarms", "%", counts.false_alarms_percent(),
              at_most(kMostContactFalseAlarms_percent)),
          row(walk + ".stance_rms", "Nm", found.stance.rms_Nm()),
          row(walk + ".swing_rms", "Nm", found.swing.rms_Nm()),
          row(walk + ".coverage", "", all.covered(), between(kLeastCovered, kMostCovered)),
          row(walk + ".half_width_over_rms", "", all.mean_bound_Nm() / all.rms_Nm(),
              at_most(kMostHalfWidthOverRms)),
          row(walk + ".model_fits", "", found.fits ? 1.0 : 0.0, at_least(1.0))};
}

}  // namespace sprung
