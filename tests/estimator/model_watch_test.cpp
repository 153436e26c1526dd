#include "estimator/model_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

constexpr double kWatchDt_s = 0.001;
constexpr double kWatchNoise_Nm = 1.0;

JointUncertainty watch_stated() {
  JointUncertainty u;
  u.friction = 0.144;
  u.torque_constant = 0.029;
  u.armature = 0.02;
  u.mass = 0.058;
  return u;
}

/// A joint of single_leg's kind that swings: friction 7.3 Nm by its law, 0.81 kg m^2, 3 Nm of weight.
class SwingingJoint {
 public:
  /// What the plant takes beyond the law.
  ModelWatch::Terms truth{};
  double speed_rad_s = 2.0;

  /// One cycle of a swing to and fro in 0.6 s.
  void step(ModelWatch& watch) {
    const double phase = 2.0 * M_PI * time_s_ / 0.6;
    WatchedMotion motion = at(speed_rad_s * std::sin(phase),
                              speed_rad_s * 2.0 * M_PI / 0.6 * std::cos(phase));
    time_s_ += kWatchDt_s;
    if (std::abs(motion.velocity_rad_s) < 0.1) return;
    const double noise_Nm = kWatchNoise_Nm * std::normal_distribution<>()(random_);
    watch.learn(motion, noise_Nm - missed_Nm(motion), kWatchNoise_Nm, kWatchDt_s);
  }
  void swing(ModelWatch& watch, double seconds) {
    for (int k = 0; k < std::lround(seconds / kWatchDt_s); ++k) step(watch);
  }
  WatchedMotion at(double velocity_rad_s, double acceleration_rad_s2) const {
    WatchedMotion motion;
    motion.velocity_rad_s = velocity_rad_s;
    motion.sign = std::copysign(1.0, velocity_rad_s);
    motion.inertia_torque_Nm = 0.81 * acceleration_rad_s2;
    motion.weight_Nm = 3.0;
    motion.link_torque_Nm = 3.0 + 0.03 * acceleration_rad_s2;
    motion.output_torque_Nm = motion.link_torque_Nm;
    motion.friction_Nm = 7.3 * motion.sign;
    motion.motor_torque_Nm = motion.output_torque_Nm + motion.inertia_torque_Nm + motion.friction_Nm;
    return motion;
  }
  double missed_Nm(const WatchedMotion& m) const {
    return truth[ModelWatch::kDry] * m.sign + truth[ModelWatch::kViscous] * m.velocity_rad_s +
           truth[ModelWatch::kLoad] * std::abs(m.output_torque_Nm) * m.sign +
           truth[ModelWatch::kInertia] * m.inertia_torque_Nm -
           truth[ModelWatch::kTorqueConstant] * m.motor_torque_Nm + truth[ModelWatch::kWeight] * m.weight_Nm;
  }

 private:
  double time_s_ = 0.0;
  std::mt19937_64 random_{1};
};

class ModelWatchTest : public testing::Test {
 protected:
  SwingingJoint joint_;
  ModelWatch watch_{watch_stated(), coulomb_alone(7.3), 0.0};
};

TEST_F(ModelWatchTest, NothingSeenFits) {
  EXPECT_TRUE(watch_.fits());
  EXPECT_EQ(watch_.ratio(), 0.0);
  EXPECT_EQ(watch_.missed(joint_.at(3.0, 0.0)).bound_Nm(), 0.0);
}

TEST_F(ModelWatchTest, ALawOfAnotherRobotFitsOnceMotionHasShownThatItDoes) {
  ModelWatch watch(watch_stated(), coulomb_alone(7.3), 171.6);
  EXPECT_FALSE(watch.fits());
  EXPECT_EQ(watch.reason(), MisfitReason::kNone);
  EXPECT_GT(watch.missed(joint_.at(8.0, 0.0)).bound_Nm(), 7.4 * 8.0) << "a published gear";
  const double unseen_Nm = watch.missed(joint_.at(2.0, 0.0)).bound_Nm();
  joint_.swing(watch, 0.6);
  EXPECT_TRUE(watch.fits());
  EXPECT_LT(watch.missed(joint_.at(2.0, 0.0)).bound_Nm(), 0.2 * unseen_Nm) << "as it was seen";
  EXPECT_GT(watch.missed(joint_.at(8.0, 0.0)).bound_Nm(), 0.5 * 7.4 * 8.0) << "quicker than it was seen";
  EXPECT_LT(watch.missed_if_free(joint_.at(8.0, 0.0)).bound_Nm(), 0.5 * 7.4 * 8.0)
      << "a contact has to be told from what was found, or the ground's push is learnt as friction";
  watch.reset();
  EXPECT_FALSE(watch.fits());
}

TEST_F(ModelWatchTest, ALawOfAnotherRobotThatIsWrongIsToldWithItsReason) {
  ModelWatch watch(watch_stated(), coulomb_alone(7.3), 171.6);
  joint_.truth[ModelWatch::kViscous] = 7.4;
  joint_.swing(watch, 0.6);
  EXPECT_FALSE(watch.fits());
  EXPECT_EQ(watch.reason(), MisfitReason::kViscousFriction);
}

TEST_F(ModelWatchTest, AFootsForceIsNotExcusedByTheFrictionThatItMakes) {
  ModelWatch watch(watch_stated(), coulomb_alone(7.3), 171.6);
  joint_.swing(watch, 3.0);
  WatchedMotion loaded = joint_.at(0.3, 0.0);
  loaded.output_torque_Nm += 60.0;
  const double free_Nm = watch.missed_if_free(joint_.at(0.3, 0.0)).bound_Nm();
  EXPECT_NEAR(watch.missed_if_free(loaded).bound_Nm(), free_Nm, 1e-9);
  EXPECT_GT(watch.missed(loaded).bound_Nm(), free_Nm + 5.0) << "no swing shows the load's share";
}

TEST_F(ModelWatchTest, RightModelFits) {
  joint_.swing(watch_, 20.0);
  EXPECT_TRUE(watch_.fits());
  EXPECT_LT(watch_.ratio(), 1.0);
}

TEST_F(ModelWatchTest, WhatRobotYamlSaysMayBeFits) {
  for (const double friction : {-0.25, 0.25}) {
    for (const double motor : {-0.05, 0.05}) {
      watch_.reset();
      joint_.truth = {};
      joint_.truth[ModelWatch::kDry] = friction * 7.3;
      joint_.truth[ModelWatch::kTorqueConstant] = motor;
      joint_.swing(watch_, 10.0);
      EXPECT_TRUE(watch_.fits()) << friction << " " << motor << ": " << watch_.ratio();
    }
  }
}

TEST_F(ModelWatchTest, HipThatFallsOrRisesIsNoMisfit) {
  for (const double share : {-1.0, 0.6}) {
    watch_.reset();
    joint_.truth[ModelWatch::kWeight] = share;
    joint_.swing(watch_, 5.0);
    EXPECT_TRUE(watch_.fits()) << share << ": " << watch_.ratio();
  }
}

TEST_F(ModelWatchTest, ViscousFrictionThatTheLawLacksIsSeenInOneSwing) {
  joint_.truth[ModelWatch::kViscous] = 7.4;
  joint_.swing(watch_, 0.6);
  EXPECT_FALSE(watch_.fits());
  EXPECT_GT(watch_.ratio(), 3.0);
  joint_.swing(watch_, 1.0);
  EXPECT_EQ(watch_.reason(), MisfitReason::kViscousFriction);
  EXPECT_NEAR(watch_.found()[ModelWatch::kViscous], 7.4, 1.5);
}

TEST_F(ModelWatchTest, ReasonIsWhatIsWrong) {
  struct Case {
    ModelWatch::Term term;
    double size;
    MisfitReason reason;
  };
  for (const Case& one : {Case{ModelWatch::kDry, 6.0, MisfitReason::kFriction},
                          Case{ModelWatch::kViscous, 5.0, MisfitReason::kViscousFriction},
                          Case{ModelWatch::kWeight, 4.0, MisfitReason::kWeight}}) {
    watch_.reset();
    joint_.truth = {};
    joint_.truth[one.term] = one.size;
    joint_.swing(watch_, 3.0);
    EXPECT_EQ(watch_.reason(), one.reason) << name(watch_.reason()) << " " << watch_.ratio();
  }
}

TEST_F(ModelWatchTest, InertiaAndTorqueConstantLookAlikeInASwingAndEitherIsSaid) {
  joint_.truth[ModelWatch::kInertia] = 0.4;
  joint_.swing(watch_, 3.0);
  EXPECT_FALSE(watch_.fits());
  EXPECT_TRUE(watch_.reason() == MisfitReason::kInertia || watch_.reason() == MisfitReason::kTorqueConstant)
      << name(watch_.reason());
}

TEST_F(ModelWatchTest, DoubtLastsUntilMotionHasToldMore) {
  watch_.doubt();
  EXPECT_FALSE(watch_.fits());
  EXPECT_EQ(watch_.reason(), MisfitReason::kNone) << "a hand may pull, too";
  EXPECT_GT(watch_.missed(joint_.at(5.0, 0.0)).bound_Nm(), 7.3) << "nothing was seen that would limit it";
  joint_.swing(watch_, 0.2);
  EXPECT_FALSE(watch_.fits());
  joint_.swing(watch_, 0.3);
  EXPECT_TRUE(watch_.fits());
}

TEST_F(ModelWatchTest, LessFrictionThanTheLawsIsAMisfitToo) {
  joint_.truth[ModelWatch::kDry] = -5.0;
  joint_.swing(watch_, 1.0);
  EXPECT_EQ(watch_.reason(), MisfitReason::kFriction);
}

TEST_F(ModelWatchTest, BoundHoldsWhatIsMissedAtSpeedsThatWereNotSeen) {
  joint_.truth[ModelWatch::kViscous] = 7.4;
  joint_.swing(watch_, 1.0);
  for (const double speed_rad_s : {-8.0, -2.0, 1.0, 6.0}) {
    const WatchedMotion motion = joint_.at(speed_rad_s, 30.0);
    EXPECT_GT(watch_.missed(motion).bound_Nm(), std::abs(joint_.missed_Nm(motion))) << speed_rad_s;
  }
}

TEST_F(ModelWatchTest, FitsAgainWhenTheMotionDoes) {
  joint_.truth[ModelWatch::kViscous] = 7.4;
  joint_.swing(watch_, 2.0);
  ASSERT_FALSE(watch_.fits());
  joint_.truth = {};
  joint_.swing(watch_, 0.05);
  EXPECT_FALSE(watch_.fits()) << "not at once";
  joint_.swing(watch_, 10.0);
  EXPECT_TRUE(watch_.fits()) << watch_.ratio();
}

TEST_F(ModelWatchTest, WhatTouchesTheLegTeachesNothing) {
  joint_.swing(watch_, 1.0);
  watch_.freeze();
  const double before = watch_.found()[ModelWatch::kDry];
  const double ratio = watch_.ratio();
  for (int k = 0; k < 1000; ++k) {  // a push that comes and is found within 35 ms, again and again
    for (int i = 0; i < 35; ++i) watch_.learn(joint_.at(1.0, 0.0), 80.0, kWatchNoise_Nm, kWatchDt_s);
    watch_.freeze();
  }
  EXPECT_EQ(watch_.found()[ModelWatch::kDry], before);
  EXPECT_EQ(watch_.ratio(), ratio);
}

TEST_F(ModelWatchTest, AFewSamplesDecideNothing) {
  joint_.truth[ModelWatch::kViscous] = 7.4;
  joint_.swing(watch_, 0.08);
  EXPECT_TRUE(watch_.fits());
}

TEST_F(ModelWatchTest, SlowCyclesAreWatchedAsWell) {
  joint_.truth[ModelWatch::kViscous] = 7.4;
  for (int k = 0; k < 200; ++k) {
    const WatchedMotion motion = joint_.at(k / 50 % 2 == 0 ? 2.0 : -2.0, 0.0);
    watch_.learn(motion, -joint_.missed_Nm(motion), kWatchNoise_Nm, 0.004);
  }
  EXPECT_FALSE(watch_.fits());
}

TEST_F(ModelWatchTest, JointWithoutFrictionAndUncertaintyIsJudgedByNothing) {
  JointUncertainty none;
  none.friction = none.torque_constant = none.armature = none.mass = 0.0;
  ModelWatch watch(none, FrictionParameters{}, 0.0);
  joint_.swing(watch, 1.0);
  EXPECT_TRUE(watch.fits());
  EXPECT_TRUE(std::isfinite(watch.ratio()));
}

TEST_F(ModelWatchTest, DoesNotAllocate) {
  const std::int64_t before = test::allocation_count();
  joint_.swing(watch_, 1.0);
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace sprung
