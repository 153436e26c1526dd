#include "tools/lab/run/experiments.h"

#include "tools/lab/bring_up/bring_up.h"
#include "tools/lab/commission/commission_experiment.h"
#include "tools/lab/estimation/adaptation_experiment.h"
#include "tools/lab/estimation/estimator_experiment.h"
#include "tools/lab/estimation/model_watch_experiment.h"
#include "tools/lab/estimation/odometry_experiment.h"
#include "tools/lab/faults/fault_experiment.h"
#include "tools/lab/friction/drag.h"
#include "tools/lab/friction/friction_sweep.h"
#include "tools/lab/gait/endurance.h"
#include "tools/lab/gait/fall_experiment.h"
#include "tools/lab/gait/ground_error.h"
#include "tools/lab/gait/parameter_experiment.h"
#include "tools/lab/gait/push_experiment.h"
#include "tools/lab/gait/stand_push.h"
#include "tools/lab/gait/walk_experiment.h"
#include "tools/lab/jump/jump_ensemble.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/landing/drop_experiment.h"
#include "tools/lab/leg/foot_return.h"
#include "tools/lab/leg/step_response.h"
#include "tools/lab/terrain/terrain_experiment.h"

namespace sprung {

std::vector<Experiment> experiments() {
  return {jump_experiment(),          foot_return_experiment(),  stand_push_experiment(),
          step_response_experiment(), drop_experiment(),         jump_ensemble_experiment(),
          walk_experiment(),          ground_error_experiment(), push_experiment(),
          endurance_experiment(),     faults_experiment(),       friction_sweep_experiment(),
          drag_experiment(),          estimator_experiment(),    commission_experiment(),
          bring_up_experiment(),      adaptation_experiment(),   parameter_experiment(),
          model_watch_experiment(),   terrain_experiment(),      odometry_experiment(),
          fall_experiment()};
}

namespace {

RobotKind kind_of(const RobotConfig& robot) {
  if (robot.why_not_standing() != nullptr) return RobotKind::kJoint;
  return robot.gaits.empty() ? RobotKind::kLeg : RobotKind::kWalker;
}

}  // namespace

std::vector<Experiment> experiments_of(const RobotConfig& robot) {
  const RobotKind kind = kind_of(robot);
  std::vector<Experiment> out;
  for (const Experiment& experiment : experiments()) {
    if (experiment.in_all.count(kind) > 0) out.push_back(experiment);
  }
  return out;
}

}  // namespace sprung
