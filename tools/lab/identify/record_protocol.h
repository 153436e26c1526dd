#pragma once
/// The motion that shows a joint's friction, inertia and weight: which moves, from the joint's limits alone.
/// Pure.
///
///   stops      at seven angles, upward and downward: weight, and friction at rest from both sides
///   speeds     eight constant speeds, spaced evenly in their logarithm, both ways: friction over speed
///   swings     back and forth with two accelerations: inertia
///
/// and back to where the joint was.
#include <vector>

#include "planner/joint_limits.h"
#include "signals/enumeration.h"
#include "signals/vec3.h"

namespace sprung::identify {

/// What moves may use; all within what the robot allows.
struct RecordRange {
  double low_rad = 0.0;  ///< of set-points
  double high_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};

/// Narrower than robot.yaml's limits by what a joint lags behind and overshoots at the accelerations below
/// (at most a quarter of the way on each side). Speed: half the limit. Acceleration: its armature takes 15 %
/// of the actuator's torque, and lags by no more than 0.03 rad under the drive's position loop.
/// @throws std::invalid_argument naming the joint when its limits leave nothing to move in.
RecordRange record_range(const RobotConfig& robot, int joint);

/// What an operator may narrow; NaN where robot.yaml alone decides.
struct AskedRange {
  double low_rad = kNaN;
  double high_rad = kNaN;
  double speed_rad_s = kNaN;
};

/// @throws std::invalid_argument where nothing is left.
RecordRange narrowed(const RecordRange& range, const AskedRange& asked);

enum class RecordPart { kApproach, kStops, kSpeeds, kSwings, kReturn };
constexpr auto words_of(RecordPart) {
  return words<RecordPart>({
      {RecordPart::kApproach, "approach"},
      {RecordPart::kStops, "stops"},
      {RecordPart::kSpeeds, "constant speeds"},
      {RecordPart::kSwings, "swings"},
      {RecordPart::kReturn, "return"},
  });
}

struct RecordMove {
  RecordPart part = RecordPart::kApproach;
  double target_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double pause_s = 0.0;  ///< at rest, after it
  int joint = -1;        ///< of the robot; -1: the one that is recorded
};

struct RecordOptions {
  double longest_pass_s = 4.0;  ///< of one pass at constant speed: slow ones cover a part of the way
  double pause_s = 0.3;         ///< at each stop
  double
      foot_weight_kg = 0.0;  ///< clamped to the foot meanwhile: less of the torque is left for acceleration
  bool loaded = false;       ///< the leg's other joints go to their loading pose first (loading_pose.h)
  AskedRange asked{};        ///< for who takes the range from the robot; record_protocol() is given one
};

/// @param from_rad where the joint is; from beyond the range it returns to the range's nearest end.
std::vector<RecordMove> record_protocol(const RecordRange& range, double from_rad,
                                        const RecordOptions& options = {});

/// Of all moves and pauses.
double duration_s(const std::vector<RecordMove>& moves, double from_rad);

}  // namespace sprung::identify
