#include "estimator/model_watch.h"

#include <algorithm>
#include <cmath>

#include "signals/joint_state.h"

namespace sprung {
namespace {

/// Samples are put together for as long: they are alike for longer (residual_model.cpp), and twelve joints
/// cost a fifth.
constexpr double kBucket_s = 5e-3;
constexpr double kAlikeFor_s = 10e-3;
/// Motion that decides: a swing.
constexpr double kWindow_s = 0.3;
constexpr double kLeastMotion_s = 0.1;
/// It fits again below. Both are standard deviations of what robot.yaml states. Plants at the corners of the
/// box that the stated numbers stand for (friction 25 %, torque constant 5 %, mass 10 %, each 1.7 of them)
/// reach up to sqrt 3 times sqrt 2.
constexpr double kFit = 1.7;
/// So many standard deviations of what was found are taken off it. With one, identified joints of legs that
/// crawl, whose slow swings say little, were doubted in one step of seven (erob_100, draw 24).
constexpr double kSure = 1.5;
/// What was found stays believed; how well it is known is forgotten over as much motion. A hip's
/// acceleration, which looks like weight, changes within a step, and so does what touches the foot: both are
/// forgotten whole.
constexpr double kForgets_s = 60.0, kForgetsWeight_s = 0.2;
/// A force that is not noticed lasts as long as a slow touchdown.
constexpr double kForgetsOutside_s = 0.1;
/// Before anything was seen, one standard deviation each: friction as much again as the law's at 1 rad/s,
/// over which viscous friction comes to as much; the load's share as that of published gears (facts D1);
/// inertia and torque constant as multiples of what robot.yaml states.
constexpr double kFrictionPrior = 1.0, kLoadPrior = 0.15, kStatedPrior = 3.0;
constexpr double kLeastFriction_Nm = 1.0;
/// The same of a gear that nobody has recorded, over what its actuator can give: 1.4 times what published
/// ones have (facts D1: 7.4 Nm s/rad where 172 Nm can be had).
constexpr double kForeignFriction = 0.06;
/// Of a leg's weight, one standard deviation: what the hip's own acceleration adds or takes away.
constexpr double kHipShare = 0.6;
/// What neither the terms nor the motion filter know of: ripple, hysteresis.
constexpr double kRest_Nm = 0.7;
/// A sample that is further off is something that touches the leg.
constexpr double kMostStds = 4.0;
constexpr double kWatchStds = 1.96;
/// Of what was found, how far it may be off in another motion, one standard deviation.
constexpr double kElsewhere = 0.2;
/// Of viscous friction before anything was seen, how much there may be besides at each rad/s beyond the
/// quickest motion that was seen: what is found at 0.4 rad/s says little of a push-off's 7.
constexpr double kQuicker = 0.8;

double square(double value) noexcept { return value * value; }

double friction_at_1_rad_s(const FrictionParameters& law) noexcept {
  return std::max(kLeastFriction_Nm, law.coulomb_Nm + law.viscous_Nm_s_rad);
}

constexpr MisfitReason kMisfitReasons[] = {MisfitReason::kFriction,       MisfitReason::kViscousFriction,
                                           MisfitReason::kLoadFriction,   MisfitReason::kInertia,
                                           MisfitReason::kTorqueConstant, MisfitReason::kWeight};

}  // namespace

double ModelWatch::Missed::bound_Nm() const noexcept {
  return std::abs(torque_Nm) + kWatchStds * std::hypot(std_Nm, kElsewhere * torque_Nm);
}

ModelWatch::ModelWatch(const JointUncertainty& stated, const FrictionParameters& law,
                       double foreign_Nm) noexcept
    : stated_(stated), foreign_(foreign_Nm > 0.0) {
  const double friction_Nm = std::max(kFrictionPrior * friction_at_1_rad_s(law),
                                      kForeignFriction * foreign_Nm);
  prior_ = {friction_Nm,
            friction_Nm,
            kLoadPrior,
            kStatedPrior * stated.armature,
            kStatedPrior * stated.torque_constant,
            kHipShare,
            1.0};
  reset();
}

void ModelWatch::reset() noexcept {
  found_ = {};
  covariance_ = {};
  moment_ = worst_ = {};
  for (std::size_t i = 0; i < kTerms; ++i) covariance_[i][i] = square(prior_[i]);
  seen_s_ = ratio_ = quickest_rad_s_ = 0.0;
  reason_ = MisfitReason::kNone;
  doubted_ = foreign_;
  freeze();
}

void ModelWatch::freeze() noexcept {
  filling_ = {};
  count_ = 0;
}

void ModelWatch::doubt() noexcept {
  doubted_ = true;
  seen_s_ = 0.0;
}

ModelWatch::Terms ModelWatch::parts(const WatchedMotion& motion) const noexcept {
  return {motion.sign,
          motion.velocity_rad_s,
          std::abs(motion.link_torque_Nm) * motion.sign,
          motion.inertia_torque_Nm,
          -motion.motor_torque_Nm,
          motion.weight_Nm,
          motion.unnoticed_Nm};
}

double ModelWatch::stated_Nm2(const WatchedMotion& motion) const noexcept {
  return square(stated_.friction * motion.friction_Nm) +
         square(stated_.torque_constant * motion.motor_torque_Nm) +
         square(stated_.armature * motion.inertia_torque_Nm) + square(stated_.mass * motion.link_torque_Nm);
}

/// Of friction seen, by all that the model may be off in besides, and by a force that is not noticed.
double ModelWatch::other_Nm2(const WatchedMotion& motion) const noexcept {
  return square(kRest_Nm) + square(stated_.torque_constant * motion.motor_torque_Nm) +
         square(stated_.armature * motion.inertia_torque_Nm) + square(stated_.mass * motion.link_torque_Nm) +
         square(kHipShare * motion.weight_Nm) + square(motion.unnoticed_Nm);
}

void ModelWatch::fill(const WatchedMotion& motion, double unexplained_Nm, double noise_std_Nm,
                      double dt_s) noexcept {
  const Terms part = parts(motion);
  for (std::size_t i = 0; i < kTerms; ++i) filling_.part[i] += dt_s * part[i];
  filling_.unexplained_Nm += dt_s * (unexplained_Nm - motion.adapted_Nm);
  filling_.noise_Nm2 += dt_s * square(noise_std_Nm);
  filling_.stated_Nm2 += dt_s * stated_Nm2(motion);
  filling_.friction.dry_Nm += dt_s * motion.friction_by_law.dry_Nm;
  filling_.friction.viscous_Nm += dt_s * motion.friction_by_law.viscous_Nm;
  filling_.moves_itself = filling_.moves_itself && motion.moves_itself;
  filling_.excess_Nm -= dt_s * unexplained_Nm;
  filling_.other_Nm2 += dt_s * (other_Nm2(motion) + square(noise_std_Nm));
  filling_.time_s += dt_s;
}

const SeenFriction* ModelWatch::learn(const WatchedMotion& motion, double unexplained_Nm, double noise_std_Nm,
                                      double dt_s) noexcept {
  fill(motion, unexplained_Nm, noise_std_Nm, dt_s);
  constexpr double kRounding_s = 1e-9;  // message times are whole microseconds
  if (filling_.time_s + kRounding_s < kBucket_s) return nullptr;
  const double each = 1.0 / filling_.time_s;
  for (double& value : filling_.part) value *= each;
  for (double* mean :
       {&filling_.unexplained_Nm, &filling_.noise_Nm2, &filling_.stated_Nm2, &filling_.friction.dry_Nm,
        &filling_.friction.viscous_Nm, &filling_.excess_Nm, &filling_.other_Nm2})
    *mean *= each;
  const bool taken = wait(filling_);
  filling_ = {};
  return taken ? &seen_ : nullptr;
}

bool ModelWatch::wait(const Bucket& bucket) noexcept {
  const bool full = count_ == kWaiting;
  if (full) {
    const Bucket& old = waiting_[next_];
    take(old);
    judge();
    seen_ = {old.friction, old.excess_Nm, std::sqrt(old.other_Nm2), old.time_s, old.moves_itself};
  } else {
    ++count_;
  }
  waiting_[next_] = bucket;
  next_ = (next_ + 1) % kWaiting;
  return full;
}

void ModelWatch::age(double time_s) noexcept {
  Terms kept{};
  for (std::size_t i = 0; i < kTerms; ++i)
    kept[i] = std::max(0.0, 1.0 - time_s / (i == kWeight    ? kForgetsWeight_s
                                            : i == kOutside ? kForgetsOutside_s
                                                            : kForgets_s));
  found_[kWeight] *= kept[kWeight];
  found_[kOutside] *= kept[kOutside];
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kTerms; ++k) covariance_[i][k] *= kept[i] * kept[k];
    covariance_[i][i] += (1.0 - square(kept[i])) * square(prior_[i]);
  }
}

void ModelWatch::take(const Bucket& bucket) noexcept {
  age(bucket.time_s);
  remember(bucket);
  quickest_rad_s_ = std::max(quickest_rad_s_, std::abs(bucket.part[kViscous]));
  const double alike = std::max(1.0, 2.0 * kAlikeFor_s / bucket.time_s);
  Terms gain{};
  double total_Nm2 = alike * (bucket.noise_Nm2 + square(kRest_Nm));
  double left_Nm = -bucket.unexplained_Nm;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kTerms; ++k) gain[i] += covariance_[i][k] * bucket.part[k];
    total_Nm2 += gain[i] * bucket.part[i];
    left_Nm -= found_[i] * bucket.part[i];
  }
  const double most_Nm = kMostStds * std::sqrt(total_Nm2);
  left_Nm = std::clamp(left_Nm, -most_Nm, most_Nm);
  for (std::size_t i = 0; i < kTerms; ++i) {
    found_[i] += gain[i] / total_Nm2 * left_Nm;
    for (std::size_t k = 0; k < kTerms; ++k) covariance_[i][k] -= gain[i] * gain[k] / total_Nm2;
  }
}

void ModelWatch::remember(const Bucket& bucket) noexcept {
  seen_s_ = std::min(kWindow_s, seen_s_ + bucket.time_s);
  const double share = std::min(1.0, bucket.time_s / seen_s_);
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kTerms; ++k)
      moment_.parts[i][k] += share * (bucket.part[i] * bucket.part[k] - moment_.parts[i][k]);
  }
  moment_.stated_Nm2 += share * (bucket.stated_Nm2 - moment_.stated_Nm2);
}

double ModelWatch::ratio_in(const Moment& motion) const noexcept {
  if (!(motion.stated_Nm2 > 0.0)) return 0.0;
  double missed_Nm2 = 0.0, unsure_Nm2 = 0.0;
  for (std::size_t i = 0; i < kWeight; ++i) {
    for (std::size_t k = 0; k < kWeight; ++k) {
      missed_Nm2 += found_[i] * motion.parts[i][k] * found_[k];
      unsure_Nm2 += covariance_[i][k] * motion.parts[i][k];
    }
  }
  const double sure_Nm = std::sqrt(std::max(0.0, missed_Nm2)) - kSure * std::sqrt(std::max(0.0, unsure_Nm2));
  return sure_Nm / std::sqrt(motion.stated_Nm2);
}

/// Weight is the hip's acceleration too, and judged by itself. A slow motion after a quick one hides viscous
/// friction: what did not fit must fit in the motion that showed it.
void ModelWatch::judge() noexcept {
  if (seen_s_ < kLeastMotion_s) return;
  const double weight = (std::abs(found_[kWeight]) - std::sqrt(covariance_[kWeight][kWeight])) / kHipShare;
  const double now = ratio_in(moment_);
  const double by_model = reason_ == MisfitReason::kNone ? now : std::max(now, ratio_in(worst_));
  ratio_ = std::max({0.0, by_model, weight});
  if (seen_s_ >= kWindow_s) doubted_ = false;
  if (ratio_ < kFit) reason_ = MisfitReason::kNone;
  if (now > kMisfitRatio && now >= by_model) worst_ = moment_;
  if (ratio_ > kMisfitRatio) reason_ = weight > by_model ? MisfitReason::kWeight : likely_reason();
}

MisfitReason ModelWatch::likely_reason() const noexcept {
  std::size_t most = kDry;
  const auto size = [this](std::size_t i) { return square(found_[i]) * worst_.parts[i][i]; };
  for (std::size_t i = kViscous; i < kWeight; ++i) {
    if (size(i) > size(most)) most = i;
  }
  return kMisfitReasons[most];
}

/// The gear's output as estimated lacks what is missed itself, so the load's share comes last.
ModelWatch::Missed ModelWatch::missed(const WatchedMotion& motion) const noexcept {
  if (fits() && !foreign_) return {};
  Terms part = parts(motion);
  const double without_load_Nm = missed_of(part, motion.adapted_Nm).torque_Nm - found_[kLoad] * part[kLoad];
  part[kLoad] = std::abs(motion.output_torque_Nm - without_load_Nm) * motion.sign;
  Missed out = missed_of(part, motion.adapted_Nm);
  const double quicker_rad_s = std::max(0.0, std::abs(motion.velocity_rad_s) - quickest_rad_s_);
  out.std_Nm = std::hypot(out.std_Nm, kQuicker * prior_[kViscous] * quicker_rad_s);
  return out;
}

ModelWatch::Missed ModelWatch::missed_if_free(const WatchedMotion& motion) const noexcept {
  if (fits() && !foreign_) return {};
  return missed_of(parts(motion), motion.adapted_Nm);
}

ModelWatch::Missed ModelWatch::missed_of(const Terms& part, double adapted_Nm) const noexcept {
  Missed out;
  out.torque_Nm = -adapted_Nm;
  double variance_Nm2 = 0.0;
  for (std::size_t i = 0; i < kWeight; ++i) out.torque_Nm += found_[i] * part[i];
  for (std::size_t i = 0; i < kWeight; ++i) {
    for (std::size_t k = 0; k < kWeight; ++k) variance_Nm2 += part[i] * covariance_[i][k] * part[k];
  }
  out.std_Nm = std::sqrt(std::max(0.0, variance_Nm2));
  return out;
}

}  // namespace sprung
