#pragma once
/// A gait that lifts one leg at a time leans: the body goes over the three feet that will go on standing, and
/// the leg waits until it is there. Level axes. Pure.
#include "planner/gait/body_law.h"
#include "planner/gait/body_view.h"
#include "planner/gait/gait_clock.h"

namespace sprung {

class WeightShift {
 public:
  explicit WeightShift(std::size_t legs) noexcept : legs_(legs) {}
  /// @param at_m how far the body leans now: a walk that was halted leaves it so.
  void begin(const Eigen::Vector2d& at_m) noexcept;

  /// One cycle, before the clock's. Gaits whose sway is 0 do not lean. @param speed_m_s of the body as
  /// wanted, without leaning.
  void step(const GaitClock& clock, const BodyView& view, const Eigen::Vector2d& speed_m_s,
            double dt_s) noexcept;

  /// The ground holds feet up: with more margin, over feet that are felt to carry, from where the weight was
  /// found to be.
  void be_careful(bool careful) noexcept { careful_ = careful; }

  /// The leg whose turn it is must not leave yet.
  bool holds() const noexcept { return holds_; }
  /// It has been waiting for kGiveUp_s.
  bool gave_up() const noexcept { return waited_s_ >= kGiveUp_s; }
  /// It leans no further than kUpright_m.
  bool upright() const noexcept { return lean_.at_m().norm() <= kUpright_m; }
  /// It leans no faster than kRest_m_s.
  bool rests() const noexcept { return lean_.speed_m_s().norm() <= kRest_m_s; }
  /// No leg is to leave any more: the body stays where it leans, instead of coming back.
  void stay() noexcept { stays_ = true; }
  void move() noexcept { stays_ = false; }
  /// Of the body, from where it is without leaning.
  const Eigen::Vector2d& at_m() const noexcept { return lean_.at_m(); }
  const Eigen::Vector2d& speed_m_s() const noexcept { return lean_.speed_m_s(); }

  static constexpr double kGiveUp_s = 4.0;
  static constexpr double kUpright_m = 0.005;
  static constexpr double kRest_m_s = 0.02;

 private:
  std::size_t lifted(const GaitClock& clock) const noexcept;
  void learn(const BodyView& view, std::size_t lifted, double dt_s) noexcept;
  void follow(const GaitClock& clock, const Eigen::Vector2d& wanted_m, double waited_s, double dt_s) noexcept;

  const std::size_t legs_;
  Lean lean_;
  Eigen::Vector2d off_m_ = Eigen::Vector2d::Zero();  ///< of the weight from where robot.yaml has it
  double waited_s_ = 0.0;
  bool careful_ = false;
  bool holds_ = false;
  bool stays_ = false;
};

}  // namespace sprung
