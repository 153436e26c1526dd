#include "planner/gait/weight_shift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/gait/capture_point.h"
#include "planner/gait/support_triangle.h"

namespace sprung {
namespace {

constexpr std::size_t kLegs = 4;    // three feet and one in the air: all that is known of leaning
constexpr double kWanted = 0.6;     // margin that the body goes for, share of the gait's sway,
constexpr double kNeeded = 0.2;     // and without which no leg leaves;
constexpr double kCareful = 0.3;    // on ground that has held a foot up lately
constexpr double kLeanTime = 0.16;  // share of the period in which nine tenths of the way are done
constexpr double kFurther = 0.5;    // of the sway, that it leans besides where it has waited for
constexpr double kFurtherIn_s = 0.5;
constexpr double kFeltWithin_s = 0.3;                      // that a foot carries; friction may hide it
constexpr double kLearns_m_s = 0.05, kForgetsIn_s = 20.0;  // [design choice] where the weight is
constexpr double kMostOff_m = 0.02;        // [design choice] of masses that are not where robot.yaml has them
constexpr double kWaitsCarefully_s = 1.0;  // more than kNeeded may be more than there is
constexpr double kFarAhead_s = 1.0;        // further the feet's way is not foreseen

std::array<Eigen::Vector2d, 3> others_m(const BodyView& view, std::size_t lifted) noexcept {
  std::array<Eigen::Vector2d, 3> feet_m;
  for (std::size_t i = 0, k = 0; i < kLegs; ++i)
    if (i != lifted) feet_m[k++] = view.foot_m[i].head<2>();
  return feet_m;
}

bool others_carry(const BodyView& view, std::size_t lifted) noexcept {
  for (std::size_t i = 0; i < kLegs; ++i)
    if (i != lifted && !view.carries[i]) return false;
  return true;
}

}  // namespace

void WeightShift::begin(const Eigen::Vector2d& at_m) noexcept {
  lean_.rest_at(at_m);
  waited_s_ = 0.0;
  off_m_.setZero();
  holds_ = stays_ = false;
}

/// The leg that swings, else the one whose turn is next.
std::size_t WeightShift::lifted(const GaitClock& clock) const noexcept {
  std::size_t next = 0;
  for (std::size_t i = 0; i < legs_; ++i) {
    if (clock.swings(i)) return i;
    if (clock.until_swing_s(i) < clock.until_swing_s(next)) next = i;
  }
  return next;
}

/// From where the body would be without leaning, halfway through the swing.
void WeightShift::step(const GaitClock& clock, const BodyView& view, const Eigen::Vector2d& speed_m_s,
                       double dt_s) noexcept {
  const double waited_s = std::exchange(waited_s_, 0.0);
  holds_ = false;
  const double sway_m = clock.gait().sway_m;
  const std::size_t leg = lifted(clock);
  const bool swings = clock.swings(leg);
  const bool to_come = swings || clock.until_swing_s(leg) <= clock.gait().period_s;
  if (sway_m <= 0.0 || legs_ != kLegs || !to_come) {
    const Eigen::Vector2d rest_m = stays_ ? lean_.at_m() : Eigen::Vector2d::Zero();
    return follow(clock, rest_m, 0.0, dt_s);
  }
  const SupportTriangle support(others_m(view, leg));
  if (swings) learn(view, leg, dt_s);
  const Eigen::Vector2d com_m = view.com_m.head<2>() + (careful_ ? off_m_ : Eigen::Vector2d::Zero());

  const double until_s = swings ? 0.0 : std::min(kFarAhead_s, clock.until_swing_s(leg));
  const double left_s = swings ? (1.0 - clock.swing_share(leg)) * clock.swing_s() : clock.swing_s();
  const Eigen::Vector2d upright_m = com_m - lean_.at_m();
  const Eigen::Vector2d then_m = (until_s + 0.5 * left_s) * speed_m_s;
  follow(clock, support.safe_place_m(upright_m + then_m, kWanted * sway_m) - upright_m - then_m, waited_s,
         dt_s);

  const Eigen::Vector2d beyond_m_s = view.velocity_known
                                         ? Eigen::Vector2d(view.velocity_m_s.head<2>() - speed_m_s)
                                         : Eigen::Vector2d::Zero();
  const bool due = clock.all_stand() && until_s <= 2.0 * dt_s;  // else it left in the next cycle
  const double margin_m = support.margin_m(com_m + capture_s(view, legs_) * beyond_m_s);
  const bool stands = !careful_ || others_carry(view, leg) || waited_s >= kFeltWithin_s;
  const double needed_m = (careful_ && waited_s < kWaitsCarefully_s ? kCareful : kNeeded) * sway_m;
  holds_ = due && !(stands && margin_m >= needed_m);  // unknown is not safe
  if (due) waited_s_ = waited_s + (holds_ ? dt_s : 0.0);
}

/// A foot of three that carries nothing: the weight is further from it than was believed.
void WeightShift::learn(const BodyView& view, std::size_t lifted, double dt_s) noexcept {
  off_m_ *= 1.0 - dt_s / kForgetsIn_s;
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Eigen::Vector2d to_foot_m = (view.foot_m[i] - view.com_m).head<2>();
    if (i == lifted || view.carries[i] || !(to_foot_m.norm() > 0.0)) continue;
    off_m_ -= kLearns_m_s * dt_s * to_foot_m.normalized();
  }
  if (off_m_.norm() > kMostOff_m) off_m_ *= kMostOff_m / off_m_.norm();
}

void WeightShift::follow(const GaitClock& clock, const Eigen::Vector2d& wanted_m, double waited_s,
                         double dt_s) noexcept {
  if (!wanted_m.allFinite()) return;  // a foot that nobody knows for a cycle
  const double far_m = wanted_m.norm(),
               most_m = (1.0 + kFurther * std::min(1.0, waited_s / kFurtherIn_s)) * clock.gait().sway_m;
  const Eigen::Vector2d within_m = far_m > most_m ? Eigen::Vector2d(wanted_m * (most_m / far_m)) : wanted_m;
  lean_.follow(within_m, kLeanTime * clock.gait().period_s, dt_s);
}

}  // namespace sprung
