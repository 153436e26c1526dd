#pragma once
/// Phases of one leg in a gait: swing, pre-stance, stance; where its foot is wanted, and what befalls it.
/// Level axes (body_frame.h). Pure.
///
///   swing       the foot goes along its path; contact on its way up is a stumble: it lifts higher. In a gait
///               that waits for each foot, one that is held up begins anew (riser_reflex.h)
///   pre-stance  the last share of the swing: contact ends it (early contact); late, the foot steps down at
///               the approach speed (late contact), and back toward where its leg hangs plumb, so that a leg
///               that reached far ahead is long enough; as far as step_down, and then it gives up (no ground)
///   stance      the foot is wanted where it landed, carried along as the body is to move over it
#include <Eigen/Geometry>

#include "planner/gait/riser_reflex.h"
#include "planner/gait/swing_path.h"
#include "robots/gait_config.h"
#include "signals/modes.h"

namespace sprung {

/// What every leg of a gait shares in this cycle.
struct StepPlan {
  const GaitConfig* gait = nullptr;
  const WalkConfig* law = nullptr;
  GaitControl control = GaitControl::kAdaptive;
  double dt_s = 0.0;
  double swing_s = 0.0;
  Eigen::Vector3d body_m_s;  ///< wanted, over the ground; z: as it climbs
  double turning_rad_s = 0.0;
  double sunk_m = 0.0;  ///< of the trunk toward the ground, as the standing feet show it, in this cycle
  /// Of a foot's ball: while it stands it rolls after the body.
  double foot_radius_m = 0.0;
  bool may_wait = false;  ///< the others stand safely while a swing begins anew
  bool bears = false;     ///< so much, on its way down, that it can only stand
  /// Of its foothold from where the leg hangs plumb.
  Eigen::Vector2d ahead_m = Eigen::Vector2d::Zero();

  /// Of a place on the ground, as the body sees it.
  Eigen::Vector3d ground_m_s(const Eigen::Vector3d& place_m) const noexcept {
    return -body_m_s - Eigen::Vector3d(0.0, 0.0, turning_rad_s).cross(place_m);
  }
  double approach_m_s() const noexcept {
    return gait->approach_m_s > 0.0 ? gait->approach_m_s : law->approach_m_s;
  }
};

class LegStep {
 public:
  /// @param since_s for which it has stood already.
  void stand(const Eigen::Vector3d& foot_m, double since_s = 0.0) noexcept;
  /// This swing is controlled as the plan says in its first cycle, whatever is asked for until it ends.
  void lift(const Eigen::Vector3d& foot_m) noexcept;

  /// One cycle. @param foot_m measured. @param foothold_m where a swing shall end; its height
  /// is that of a swing's first cycle, but for the trunk's sinking.
  /// @return true when the foot landed, or gave up, in this cycle.
  bool step(const StepPlan& plan, const Eigen::Vector3d& foot_m, const Eigen::Vector3d& foothold_m,
            bool contact) noexcept;

  LegPhase phase() const noexcept { return phase_; }
  GaitControl control() const noexcept { return control_; }
  double in_phase_s() const noexcept { return in_phase_s_; }
  bool stands() const noexcept { return phase_ == LegPhase::kStance; }
  bool gave_up() const noexcept { return gave_up_; }
  /// Beyond the end of the swing, still looking for the ground.
  bool late(const StepPlan& plan) const noexcept { return !stands() && in_swing_s_ >= plan.swing_s; }
  /// In this swing, so that it began anew.
  bool held_up() const noexcept { return !stands() && riser_.goes_over(); }
  /// Its swing, which began anew, is younger than one of the clock's is now.
  bool behind(double age_s) const noexcept { return held_up() && in_swing_s_ < age_s; }
  const Eigen::Vector3d& wanted_m() const noexcept { return wanted_m_; }
  const Eigen::Vector3d& wanted_m_s() const noexcept { return wanted_m_s_; }
  const Eigen::Vector3d& wanted_m_s2() const noexcept { return wanted_m_s2_; }
  /// Of its wanted place from where it was, when it left the ground.
  const Eigen::Vector3d& stretch_at_lift_m() const noexcept { return stretch_at_lift_m_; }
  /// Moves the wanted place of a standing foot, e.g. for the height of the body.
  void shift(const Eigen::Vector3d& by_m) noexcept { wanted_m_ += by_m; }
  LegEvent last_event() const noexcept { return last_event_; }
  const std::array<std::int32_t, kLegEventCount>& counts() const noexcept { return counts_; }
  void forget_event() noexcept { last_event_ = LegEvent::kNone; }
  void note(LegEvent event) noexcept;

 private:
  void enter(LegPhase phase) noexcept;
  void swing(const StepPlan& plan, const Eigen::Vector3d& foothold_m) noexcept;
  void mind_riser(const StepPlan& plan, const Eigen::Vector3d& foot_m,
                  const Eigen::Vector3d& foothold_m) noexcept;
  void search_back(const StepPlan& plan, double over_s) noexcept;
  void look(const StepPlan& plan, bool contact) noexcept;
  bool landed(const StepPlan& plan, bool contact) noexcept;

  LegPhase phase_ = LegPhase::kStance;
  double in_phase_s_ = 0.0;
  double in_swing_s_ = 0.0;
  double extra_lift_m_ = 0.0;  ///< as ramped since it stumbled
  double held_up_s_ = 0.0;     ///< contact on the way up, so far
  bool stumbled_ = false;      ///< in this swing
  RiserReflex riser_;
  Eigen::Vector2d further_m_ = Eigen::Vector2d::Zero();  ///< than the plan's foothold, over a riser
  Eigen::Vector3d left_m_ = Eigen::Vector3d::Zero();     ///< where it stood, carried along with the ground
  GaitControl control_ = GaitControl::kAdaptive;
  bool gave_up_ = false;
  double ground_z_m_ = 0.0;  ///< where this swing expects it, from its first cycle on
  Eigen::Vector3d from_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d stretch_at_lift_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wanted_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wanted_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wanted_m_s2_ = Eigen::Vector3d::Zero();
  LegEvent last_event_ = LegEvent::kNone;
  std::array<std::int32_t, kLegEventCount> counts_{};
  static_assert(is_dense<LegEvent>(), "an event's value is its place in counts_");
};

}  // namespace sprung
