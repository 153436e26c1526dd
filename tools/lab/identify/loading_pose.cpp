#include "tools/lab/identify/loading_pose.h"

#include "model/leg_kinematics.h"
#include "tools/lab/identify/drive_series.h"

namespace sprung::identify {
namespace {

constexpr int kAngles = 5;                 ///< tried of each other joint
constexpr double kGentleSpeedShare = 0.1;  ///< of what the recording may use
constexpr double kGentleAcceleration = 0.4;

double part_of(const RecordRange& range, int k) {
  return range.low_rad + (range.high_rad - range.low_rad) * k / (kAngles - 1);
}

/// Sum of squares over the recorded range.
double squared_levers_m2(const LegKinematics& leg, int place, const RecordRange& recorded,
                         JointVector pose_rad) {
  double sum_m2 = 0.0;
  for (int k = 0; k < kAngles; ++k) {
    pose_rad[place] = part_of(recorded, k);
    const double lever_m = leg.jacobian(pose_rad)(2, place);
    sum_m2 += lever_m * lever_m;
  }
  return sum_m2;
}

}  // namespace

std::vector<HeldJoint> loading_pose(const RobotConfig& robot, int joint) {
  const LegPlace at = place_of(robot, joint);
  const LegConfig& leg = robot.legs[at.leg];
  const auto kinematics = make_leg_kinematics(leg);
  const int joints = static_cast<int>(leg.joints.size());
  if (!kinematics || joints < 2) return {};
  std::vector<RecordRange> ranges;
  for (const int other : leg.joints) ranges.push_back(record_range(robot, other));
  int poses = 1;
  for (int j = 0; j < joints; ++j) poses *= j == at.place ? 1 : kAngles;
  JointVector best_rad(joints);
  double most_m2 = -1.0;
  for (int pose = 0; pose < poses; ++pose) {
    JointVector tried_rad = JointVector::Zero(joints);
    for (int j = 0, rest = pose; j < joints; ++j) {
      if (j == at.place) continue;
      tried_rad[j] = part_of(ranges[j], rest % kAngles);
      rest /= kAngles;
    }
    const double lever_m2 = squared_levers_m2(*kinematics, at.place, ranges[at.place], tried_rad);
    if (lever_m2 <= most_m2) continue;
    most_m2 = lever_m2;
    best_rad = tried_rad;
  }
  std::vector<HeldJoint> out;
  for (int j = 0; j < joints; ++j) {
    if (j != at.place) out.push_back({leg.joints[j], best_rad[j]});
  }
  return out;
}

std::vector<RecordMove> loading_moves(const RobotConfig& robot, int joint) {
  std::vector<RecordMove> out;
  for (const HeldJoint& held : loading_pose(robot, joint)) {
    const RecordRange range = record_range(robot, held.joint);
    RecordMove move;
    move.part = RecordPart::kApproach;
    move.target_rad = held.position_rad;
    move.speed_rad_s = kGentleSpeedShare * range.speed_rad_s;
    move.acceleration_rad_s2 = kGentleAcceleration * range.acceleration_rad_s2;
    move.joint = held.joint;
    out.push_back(move);
  }
  return out;
}

}  // namespace sprung::identify
