#pragma once
/// A joint with every term of the friction law switched on, and points to look at it.
#include <vector>

#include "model/friction/friction_law.h"

namespace sprung {

inline FrictionParameters full_friction() {
  FrictionParameters p;
  p.coulomb_Nm = 3.3;  // facts C4, an N = 50 joint
  p.stribeck_Nm = 1.0;
  p.stribeck_speed_rad_s = 0.15;
  p.stribeck_exponent = 1.7;
  p.viscous_Nm_s_rad = 1.3;
  p.viscous_exponent = 0.8;
  p.load_share_driving = 0.063;
  p.load_share_driven = 0.12;
  p.asymmetry = 0.07;
  p.presliding_rad = 7e-4;
  p.viscous_temperature_1_K = 0.03;
  p.coulomb_temperature_1_K = 0.004;
  return p;
}

inline FrictionInput at(double velocity_rad_s, double load_Nm = 0.0, double temperature_C = 24.0) {
  FrictionInput in;
  in.velocity_rad_s = velocity_rad_s;
  in.gear_output_torque_Nm = load_Nm;
  in.temperature_C = temperature_C;
  return in;
}

/// Both directions, slow to fast, driving and driven, cold and warm.
inline std::vector<FrictionInput> many_points() {
  std::vector<FrictionInput> points;
  for (const double speed : {-4.0, -0.3, -0.02, 0.005, 0.1, 2.0}) {
    for (const double load : {-60.0, -5.0, 8.0, 120.0}) {
      for (const double temperature : {10.0, 24.0, 50.0}) points.push_back(at(speed, load, temperature));
    }
  }
  return points;
}

}  // namespace sprung
