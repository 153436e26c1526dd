#pragma once
/// What a person does to the trunk of a standing robot (S1, Fig. 11: "pounded, lifted, pushed down"). Pure.
#include <vector>

namespace sprung {

struct TrunkPush {
  const char* name = "";    ///< of rows
  double force_N = 0.0;     ///< up; or
  double distance_m = 0.0;  ///< up: the trunk is led so far, and let go as slowly
  double rise_s = 1.0;      ///< > 0; to the whole force or distance, and back
  double hold_s = 0.0;
  double length_s() const noexcept { return 2.0 * rise_s + hold_s; }
};

/// impulse: pounded, 15 N s in 0.1 s. pushdown: led down by 10 mm within 1 s, held for 1 s. lift: led up by
/// 30 mm. pushforce: pressed down with 150 N. impulse_30Ns, pushdown_30mm: so much that position control
/// answers with tens of Nm, as on the axis of S1's Fig. 11 (0 to 100 Nm). The slow push that is the same
/// disturbance for both controls is the one of the same way: under the same slow force the gears' outputs
/// carry the same load whatever the control, by statics.
std::vector<TrunkPush> trunk_pushes();

/// One push. It leads by a stiff spring.
class TrunkHand {
 public:
  static constexpr double kStiffness_N_m = 1e5, kDamping_N_s_m = 1000.0;

  TrunkHand(const TrunkPush& push, double step_s) noexcept : push_(push), step_s_(step_s) {}
  /// Once a cycle. @param time_s since the push began. @param risen_m of the trunk, since then. @return force
  /// on it, N, up.
  double step_N(double time_s, double risen_m) noexcept;

 private:
  /// Of force or distance.
  double share(double time_s) const noexcept;

  TrunkPush push_;
  double step_s_;
  double last_m_ = 0.0;
};

}  // namespace sprung
