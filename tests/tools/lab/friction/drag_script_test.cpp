#include "tools/lab/friction/drag_script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sprung {
namespace {

TEST(DragScript, TheHandMovesWithoutJumpsAndRestsAtBothEnds) {
  for (const DragPhase& phase : drag_script(true)) {
    const double step_s = 1e-4;
    HandPoint before = hand_at(phase, 0.0);
    EXPECT_EQ(before.angle_rad, 0.0) << phase.name;
    EXPECT_EQ(before.velocity_rad_s, 0.0) << phase.name;
    for (double t = step_s; t < phase.duration_s; t += step_s) {
      const HandPoint now = hand_at(phase, t);
      const double expected = before.angle_rad + 0.5 * step_s * (before.velocity_rad_s + now.velocity_rad_s);
      ASSERT_NEAR(now.angle_rad, expected, 1e-6) << phase.name << " at " << t;
      before = now;
    }
    EXPECT_EQ(before.velocity_rad_s, 0.0) << phase.name;
    if (phase.strokes.empty()) continue;
    EXPECT_EQ(before.angle_rad, phase.strokes.back().to_rad) << phase.name;
  }
}

TEST(DragScript, StrokesGoBothWaysSlowlyAndQuickly) {
  double fastest = 0.0, slowest = 1e9;
  bool forward = false, back = false;
  for (const DragPhase& phase : drag_script(true)) {
    if (phase.drive_on || phase.strokes.size() < 2) continue;
    double peak = 0.0;
    for (double t = 0.0; t < phase.duration_s; t += 1e-3) {
      const double w = hand_at(phase, t).velocity_rad_s;
      forward = forward || w > 0.1;
      back = back || w < -0.1;
      peak = std::max(peak, std::abs(w));
    }
    fastest = std::max(fastest, peak);
    slowest = std::min(slowest, peak);
  }
  EXPECT_TRUE(forward && back);
  EXPECT_GT(fastest, 4.0 * slowest);
}

TEST(DragScript, WithoutPowerOnlyWhereTheLinkCanSwingAlone) {
  std::set<std::string> names;
  bool off = false;
  for (const DragPhase& phase : drag_script(true)) {
    EXPECT_TRUE(names.insert(phase.name).second) << phase.name;
    off = off || !phase.drive_on;
  }
  EXPECT_TRUE(off);
  for (const DragPhase& phase : drag_script(false)) EXPECT_TRUE(phase.drive_on) << phase.name;
}

TEST(DragScript, TheFootPullsTowardWhereItIsAndAgainstTheLinksSpeed) {
  const HandGrip grip{100.0, 10.0};
  EXPECT_DOUBLE_EQ(hand_torque_Nm(grip, {0.2, 0.0}, 0.1, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(hand_torque_Nm(grip, {0.1, 0.0}, 0.2, 0.0), -10.0);
  EXPECT_DOUBLE_EQ(hand_torque_Nm(grip, {0.1, 0.0}, 0.1, 0.5), -5.0);
  EXPECT_DOUBLE_EQ(hand_torque_Nm(grip, {0.1, 0.5}, 0.1, 0.5), 0.0);
}

}  // namespace
}  // namespace sprung
