#pragma once
/// One joint's recording from the DRIVE_STATEs of a robot: the drives' own measurements through robot.yaml's
/// transmission, nothing that the estimator says. Pure but for reading the log.
///
/// A joint is identified while it moves alone: then its weight is a sine and a cosine of its own angle, and
/// its inertia is constant. So samples count only where
///   - its drives are enabled and answered,
///   - the other joints of its leg hold the pose in which it moved most (within 0.02 rad),
///   - it moves: at rest a motor gives anything between the friction of both directions.
#include <string>
#include <vector>

#include "estimator/identification/raw_series.h"
#include "robots/robot_config.h"
#include "signals/drive_state.h"

namespace sprung::identify {

struct DriveSeries {
  identification::RawSeries series;
  std::vector<double> pose_rad;    ///< of its leg's joints in that pose, its own too
  std::vector<std::string> notes;  ///< what was left out and why
  double moving_s = 0.0;           ///< how long the samples that count last
};

/// @param joint index into RobotConfig::joints. @param states in order; repeated ones are left out.
/// @param foot_weight_kg clamped to the foot while the hip stayed level: the series then knows its load.
/// @throws std::runtime_error where the joint hardly moves (alone) in the recording, saying what to record;
/// std::invalid_argument on a weight at a leg whose links are not known.
DriveSeries drive_series(const RobotConfig& robot, int joint, const std::vector<DriveState>& states,
                         double foot_weight_kg = 0.0);

/// Recordings of one joint, one after the other with a gap between: with different weights at the foot they
/// show what friction owes to the load. @param parts not empty. @throws std::runtime_error where the leg's
/// other joints were not held alike.
DriveSeries joined(std::vector<DriveSeries> parts);

/// Index of the leg that has this joint, and the joint's place in it.
struct LegPlace {
  int leg = -1;
  int place = -1;
};
LegPlace place_of(const RobotConfig& robot, int joint);

/// DRIVE_STATEs of an LCM log.
struct DriveLog {
  std::vector<DriveState> states;
  std::vector<std::string> notes;  ///< messages that were left out
};

/// Of the first session that the log holds.
/// @throws std::runtime_error when the file is no LCM log or holds no DRIVE_STATE of this robot.
DriveLog read_drive_log(const std::string& path, const RobotConfig& robot);

/// Robot that the log names itself; "" where it does not. @throws as above.
std::string robot_of_log(const std::string& path);

}  // namespace sprung::identify
