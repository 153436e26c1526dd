#pragma once
/// What is done to the joint in `sprung experiment drag`: a hand on the link that goes its own way, and the
/// drive off, holding or moving. Pure.
#include <string>
#include <vector>

namespace sprung {

/// A hand as a spring and damper about the joint: what it pulls with when the link is not where the hand is.
struct HandGrip {
  double stiffness_Nm_rad = 0.0;
  double damping_Nm_s_rad = 0.0;
};

struct HandPoint {
  double angle_rad = 0.0;  ///< from where the hand took hold
  double velocity_rad_s = 0.0;
};

/// One movement of the hand, from rest to rest along a quintic.
struct HandStroke {
  double to_rad = 0.0;  ///< from where the hand took hold
  double duration_s = 0.0;
};

struct DragPhase {
  std::string name;       ///< of report rows: no spaces
  bool drive_on = false;  ///< false: no power, as when nobody commands
  HandGrip grip;          ///< zero: nobody touches the link
  std::vector<HandStroke> strokes;
  double duration_s = 0.0;        ///< the hand rests after its last stroke
  std::vector<double> moves_rad;  ///< where the drive takes the joint meanwhile, from where the phase began
  double move_speed_rad_s = 0.0;
};

/// @param drive_can_be_off the joint can swing by itself: with several joints the others would give way too.
std::vector<DragPhase> drag_script(bool drive_can_be_off);

/// Where the hand is. Before the first stroke and after the last it rests.
HandPoint hand_at(const DragPhase& phase, double time_s);
/// @param angle_rad of the link, from where the hand took hold.
double hand_torque_Nm(const HandGrip& grip, const HandPoint& hand, double angle_rad, double velocity_rad_s);

}  // namespace sprung
