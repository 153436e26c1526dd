#pragma once
/// MOTION_STATE: what the planner is doing. Units and frames: lcmtypes/README.md. Vectors are sized once, by
/// the constructor, so that a step allocates nothing.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct MotionLeg {
  LegPhase phase = LegPhase::kIdle;
  double phase_time_s = 0.0;
  LegEvent last_event = LegEvent::kNone;                    ///< in this gait
  std::array<std::int32_t, kLegEventCount> event_counts{};  ///< since the planner began, by LegEvent
  /// Of the ground below the foot, from the trunk's origin along the vertical; NaN while it does not walk.
  double estimated_ground_z_m = kNaN;
  double estimated_ground_z_bound_m = kNaN;
};

/// What the trunk carries beyond robot.yaml's masses. A bound: |error| is below it at about 95 %.
struct EstimatedPayload {
  double mass_kg = kNaN;  ///< below 0: it is lighter than robot.yaml says; NaN until it has stood up
  double mass_bound_kg = kNaN;
  /// From the middle of the hips, forward and left; NaN where it may be none.
  std::array<double, 2> in_trunk_m{kNaN, kNaN};
};

struct MotionState {
  Stamp stamp;
  std::vector<MotionLeg> legs;
  MotionPhase state = MotionPhase::kIdle;
  std::int32_t jumps_done = 0;
  std::int32_t jumps_left = 0;
  double jump_height_scale = 1.0;
  double estimated_jump_height_m = kNaN;  ///< of the last jump, from its flight time and leg lengths
  JumpMode jump_mode = JumpMode::kHybrid;
  std::int32_t gait = -1;       ///< index into the robot's gaits; -1 = none
  double gait_phase = 0.0;      ///< share of the gait's period, 0..1
  Vec3 desired_speed{0, 0, 0};  ///< forward m/s, left m/s, turning rad/s; as ramped
  /// Of the ground: rise over way, forward and left of the trunk's heading; NaN while it does not walk.
  std::array<double, 2> estimated_ground_slope{kNaN, kNaN};
  std::array<double, 2> estimated_ground_slope_bound{kNaN, kNaN};
  EstimatedPayload payload;
  const char* last_transition = "";  ///< points to static text
  MotionState() = default;
  explicit MotionState(std::size_t leg_count) : legs(leg_count) {}
};

}  // namespace sprung
