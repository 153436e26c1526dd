#pragma once
/// A robot in a gait: the clock's turns, each leg's steps, the body over them, and how its weight is shared
/// out. Standing on virtual springs is the gait whose legs never swing. Pure: no heap after construction,
/// never throws in step. docs/locomotion.md.
#include <array>

#include "planner/gait/body_law.h"
#include "planner/gait/force_distribution.h"
#include "planner/gait/gait_order.h"
#include "planner/gait/ground_plane.h"
#include "planner/gait/heat_lean.h"
#include "planner/gait/leg_step.h"
#include "planner/gait/motor_heat.h"
#include "planner/gait/pace.h"
#include "planner/gait/speed_ramp.h"
#include "planner/gait/weight_shift.h"
#include "robots/parameters.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/vec3.h"

namespace sprung {

struct WalkRequest {
  int gait = -1;                  ///< index into RobotConfig::gaits
  std::array<double, 3> speed{};  ///< forward, left m/s; turning rad/s
  double height_m = 0.0;
  double stance_width_m = 0.0;
  GaitControl control = GaitControl::kAdaptive;
};

class Walk {
 public:
  /// @throws std::invalid_argument on legs that cannot be walked on.
  Walk(const RobotConfig& robot, const PresetConfig& preset);

  /// Why this cannot be done from where it is; nullptr: it can.
  const char* validate(const WalkRequest& request, bool walking) const noexcept;
  void begin(const JointState& in, const WalkRequest& request) noexcept;
  /// Speed, height and width are ramped; another gait begins when all feet stand, one that never swings once
  /// it stands still as after stop().
  void change(const WalkRequest& request) noexcept;
  const WalkRequest& request() const noexcept { return request_; }
  /// Gains and gaits are others now: of the same gaits, in the same order.
  void adjust(const AdjustableConfig& config) noexcept;
  /// From the next cycle on.
  void carry(const LoadOnTrunk& load) noexcept { shape_.carry(load); }
  /// As far as that gait goes now.
  WalkRequest within_limits(WalkRequest request) const noexcept;
  /// Slows down and sets every foot in its place once, then stands.
  void stop() noexcept;
  /// As stop(), within kHalt_s, of whom nobody watches any more: no step begins that would last longer, and a
  /// foot that is not set anew stays where it stands.
  void halt() noexcept;
  bool ended() const noexcept { return ended_; }
  /// Why it ended by itself; nullptr: it did not.
  const char* failure() const noexcept { return failure_; }

  void step(const JointState& in) noexcept;
  /// In this cycle, of a gait that steps: its clock begins a period; one in which every leg had its turn ends
  /// with that, none that was held or began in its middle.
  bool period_begins() const noexcept { return period_begins_; }
  bool whole_period_ended() const noexcept { return whole_period_ended_; }
  const BodyView& view() const noexcept { return view_; }       ///< of this cycle
  double swing_s() const noexcept { return clock_.swing_s(); }  ///< of a foot of its gait
  void write(std::size_t leg, DesiredLeg& out) const noexcept;
  void write(MotionState& out) const noexcept;

  /// Along the ground; heading is not used.
  const Attitude& wanted_trunk() const noexcept { return trunk_; }

  /// Where a leg's foot stands, in hip axes, at that height and width: before and after walking too.
  Vec3 stance_foot_in_hip_m(std::size_t leg, double height_m) const noexcept;

  // What validate() lets through: of the preset's stand_length, and how far each foot stands further out.
  static constexpr double kLowestShare = 0.6;
  static constexpr double kHighestShare = 1.05;  ///< straighter legs have no vertical stiffness left to give
  static constexpr double kNarrowest_m = -0.05;
  static constexpr double kWidest_m = 0.15;
  /// [design choice] With a hold of 0.5 s and Motion's recovery of 0.55 s the robot stands within 2 s.
  static constexpr double kHalt_s = 0.8;

 private:
  Pace::Speed desired_speed() const noexcept;
  void steer(double dt_s) noexcept;
  void lean(double dt_s) noexcept;
  bool looks_on(std::size_t leg) const noexcept;
  void step_legs(const JointState& in, double dt_s) noexcept;
  bool bears(std::size_t i, const EstimatedLeg& leg) const noexcept;
  bool fell(std::size_t leg, double by_m) const noexcept;
  void look_for_slip(std::size_t leg) noexcept;
  void yield(std::size_t leg) noexcept;
  GroundPlane::Feet ground_feet() const noexcept;
  void follow_ground(double dt_s) noexcept;
  void lie_along_ground() noexcept;
  void hold_height(double dt_s) noexcept;
  void share_weight() noexcept;
  GaitOrder order_of(const WalkRequest& request) const noexcept;
  void start_clock() noexcept;
  void advance_clock(double dt_s) noexcept;
  bool comes_to_rest() const noexcept;
  bool has_a_way(std::size_t gait) const noexcept;
  bool slow_enough() const noexcept;
  void hold_for_next() noexcept;
  void next_gait() noexcept;
  void place_feet() noexcept;
  void follow_lead(double dt_s) noexcept;
  void run_out(double dt_s) noexcept;
  bool rests() const noexcept;
  void fail(const char* why) noexcept;
  Eigen::Vector2d leaning_m() const noexcept;
  Eigen::Vector3d under_hip_m(std::size_t leg) const noexcept;
  Eigen::Vector3d place_m(std::size_t leg) const noexcept;
  Eigen::Vector3d foothold_m(std::size_t leg) const noexcept;
  double load(std::size_t leg) const noexcept;
  void join(std::size_t leg) noexcept;
  Eigen::Vector3d pull_m(std::size_t joining) const noexcept;
  bool on_spring(std::size_t leg) const noexcept;
  const GaitConfig& gait() const noexcept { return clock_.gait(); }

  WalkConfig law_;
  std::vector<GaitConfig> gaits_;
  /// Of the same indices; a gait that is its own mirror image is itself.
  std::vector<GaitConfig> backward_gaits_;
  const double cycle_s_;
  const double stand_height_m_;     ///< robot.yaml's: heights are allowed by it
  double stance_friction_ = 0.0;    ///< compensated of a standing foot's joints while others swing
  double standing_friction_ = 0.0;  ///< and in a gait that never swings
  BodyShape shape_;
  WeightShift weight_;
  GaitClock clock_;
  SpeedRamp ramp_;
  MotorHeat heat_;
  double careful_s_ = 0.0;  ///< for which it goes on minding that a foot was held up
  HeatLean heat_lean_;
  ForceDistribution distribution_;
  std::array<LegStep, kMostLegs> steps_;
  std::vector<FootLoad> feet_;
  std::array<Eigen::Vector3d, kMostLegs> force_N_;  ///< ground on foot, level axes; written by begin()
  BodyView view_;
  WalkRequest request_;
  GaitOrder now_;
  GaitOrder wanted_;       ///< as soon as it can be
  double height_m_ = 0.0;  ///< as ramped
  double width_m_ = 0.0;
  GroundPlane ground_;
  Attitude trunk_;                                                   ///< as wanted: along the ground
  Eigen::Matrix3d level_from_ground_ = Eigen::Matrix3d::Identity();  ///< of a trunk so
  double heading_rad_ = 0.0;
  double turning_rad_s_ = 0.0;  ///< as steered
  Eigen::Vector3d body_m_s_ = Eigen::Vector3d::Zero();
  bool waits_ = false;  ///< the clock, for a foot that is late or the body's weight
  Pace pace_;
  bool stopping_ = false;
  bool halting_ = false;
  double halt_left_s_ = 0.0;
  bool ended_ = true;
  bool period_begins_ = false;
  bool whole_period_ended_ = false;
  bool whole_period_ = false;  ///< so far, of the one that is under way
  double lead_s_ = 0.0;        ///< how long the body goes on until it is over a foot that lands now
  bool placing_ = false;       ///< each foot is set once more: where its place is when the body rests
  std::int64_t last_us_ = 0;
  const char* failure_ = nullptr;
};

}  // namespace sprung
