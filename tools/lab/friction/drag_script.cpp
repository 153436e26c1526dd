#include "tools/lab/friction/drag_script.h"

namespace sprung {
namespace {

/// Of an arm of 0.4 m that is 2000 and 150 N/m and 125 and 30 N s/m: a firm grip, and one that gives way.
constexpr HandGrip kFirm{320.0, 20.0};
constexpr HandGrip kSoft{24.0, 5.0};

/// A deliberate pull, and S0's "several" of them: slow ones stay near breakaway, brisk ones reach 2.5 rad/s.
std::vector<DragPhase> unpowered() {
  return {
      {"off_slow_strokes", false, kFirm, {{0.6, 2.0}, {-0.6, 4.0}, {0.6, 4.0}, {0.0, 2.0}}, 12.5, {}, 0.0},
      {"off_brisk_strokes", false, kFirm, {{0.8, 0.9}, {-0.8, 1.2}, {0.8, 1.2}, {0.0, 0.9}}, 4.7, {}, 0.0},
      {"off_hold", false, kFirm, {{0.7, 1.0}}, 4.0, {}, 0.0},
      {"off_quick_push", false, kFirm, {{-0.35, 0.2}, {0.0, 0.2}}, 1.5, {}, 0.0},
      {"off_let_go", false, {}, {}, 1.0, {}, 0.0},
  };
}

std::vector<DragPhase> powered() {
  return {
      {"held_push_and_pull", true, kFirm, {{0.07, 1.0}, {-0.07, 2.0}, {0.07, 2.0}, {0.0, 1.0}}, 6.5, {}, 0.0},
      {"held_hold", true, kFirm, {{0.06, 0.5}}, 3.0, {}, 0.0},
      {"held_quick_push", true, kFirm, {{0.12, 0.08}, {0.0, 0.08}}, 1.0, {}, 0.0},
      {"moved_against_hand", true, kSoft, {}, 0.5, {0.5, -0.5, 0.5, 0.0}, 0.8},
  };
}

}  // namespace

std::vector<DragPhase> drag_script(bool drive_can_be_off) {
  std::vector<DragPhase> out;
  if (drive_can_be_off) out = unpowered();
  for (const DragPhase& phase : powered()) out.push_back(phase);
  return out;
}

HandPoint hand_at(const DragPhase& phase, double time_s) {
  double from_rad = 0.0;
  for (const HandStroke& stroke : phase.strokes) {
    if (time_s <= 0.0) break;
    const double way_rad = stroke.to_rad - from_rad;
    if (time_s < stroke.duration_s) {
      const double s = time_s / stroke.duration_s;
      const double position = s * s * s * (10.0 + s * (6.0 * s - 15.0));
      const double velocity = 30.0 * s * s * (1.0 - s) * (1.0 - s) / stroke.duration_s;
      return {from_rad + way_rad * position, way_rad * velocity};
    }
    time_s -= stroke.duration_s;
    from_rad = stroke.to_rad;
  }
  return {from_rad, 0.0};
}

double hand_torque_Nm(const HandGrip& grip, const HandPoint& hand, double angle_rad, double velocity_rad_s) {
  return grip.stiffness_Nm_rad * (hand.angle_rad - angle_rad) +
         grip.damping_Nm_s_rad * (hand.velocity_rad_s - velocity_rad_s);
}

}  // namespace sprung
