#include "estimator/residual_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

constexpr double kResidualModelDt_s = 0.001;
constexpr ErrorShares kResidualModelPrior{0.15, 0.02, 0.03, 0.6};

/// A joint that swings: friction by sign, inertia and motor torque by acceleration.
JointResidual swing(int k, const ErrorShares& truth, double noise_Nm, double contact_Nm = 0.0) {
  const double phase = 0.02 * k;
  JointResidual in;
  in.part_Nm = {std::cos(phase) > 0.0 ? 7.0 : -7.0, -80.0 * std::sin(phase),
                -85.0 * std::sin(phase) + 7.0 * std::cos(phase), 0.5};
  in.torque_Nm = noise_Nm + contact_Nm;
  for (std::size_t i = 0; i < kErrorSources; ++i) in.torque_Nm += truth[i] * in.part_Nm[i];
  return in;
}

class ResidualModelTest : public testing::Test {
 protected:
  void run(int samples, const ErrorShares& truth, bool free = true, double contact_Nm = 0.0) {
    for (int i = 0; i < samples; ++i)
      model_.step(swing(k_++, truth, noise_(random_), contact_Nm), kResidualModelDt_s, free);
  }
  std::mt19937 random_{7};
  std::normal_distribution<double> noise_{0.0, 0.3};
  ResidualModel model_{kResidualModelPrior, 0.7, kResidualModelDt_s};
  int k_ = 0;
};

TEST_F(ResidualModelTest, AtFirstTheErrorIsWhatThePriorSays) {
  JointResidual in;
  in.part_Nm = {7.0, 100.0, 0.0, 0.0};
  in.torque_Nm = 3.0;
  model_.step(in, kResidualModelDt_s, true);
  EXPECT_NEAR(model_.torque_Nm(), 3.0, 1e-12);
  EXPECT_NEAR(model_.model_Nm2(), 0.15 * 0.15 * 49.0 + 4.0, 1e-9);
  EXPECT_NEAR(model_.noise_Nm2(), 0.49, 1e-9);
}

TEST_F(ResidualModelTest, ASwingShowsWhatIsWrong) {
  const ErrorShares truth{0.2, 0.03, -0.03, 0.5};
  run(100, truth);
  const double before_Nm2 = model_.model_Nm2();
  run(1500, truth);
  EXPECT_LT(model_.model_Nm2(), 0.2 * before_Nm2);
  double sum_Nm2 = 0.0, worst_Nm = 0.0;
  for (int i = 0; i < 500; ++i) {
    run(1, truth);
    sum_Nm2 += model_.torque_Nm() * model_.torque_Nm();
    worst_Nm = std::max(worst_Nm, std::abs(model_.torque_Nm()));
  }
  EXPECT_LT(std::sqrt(sum_Nm2 / 500.0), 0.5);  // noise alone is 0.3; the error was 3
  EXPECT_LT(worst_Nm, 1.6);
}

TEST_F(ResidualModelTest, NoiseIsWhatTheSwingShows) {
  run(3000, {});
  EXPECT_NEAR(std::sqrt(model_.noise_Nm2()), 0.3, 0.1);
}

TEST_F(ResidualModelTest, WhatHappenedInTheLastMomentsIsNotLearntYet) {
  run(1000, {});
  ResidualModel quiet = model_;
  const int at = k_;
  run(20, {}, true, 30.0);  // a contact that is found after 20 ms
  run(1, {}, false, 30.0);
  quiet.step(swing(at + 20, {}, 0.0), kResidualModelDt_s, false);
  JointResidual probe = swing(at + 21, {}, 0.0);
  model_.step(probe, kResidualModelDt_s, false);
  quiet.step(probe, kResidualModelDt_s, false);
  EXPECT_NEAR(model_.torque_Nm(), quiet.torque_Nm(), 0.2);
}

TEST_F(ResidualModelTest, ContactIsNoErrorToLearn) {
  run(500, {}, false, 30.0);
  EXPECT_NEAR(model_.torque_Nm(), 30.0, 2.0);
}

TEST_F(ResidualModelTest, LongAgoIsForgotten) {
  run(2000, {0.2, 0.0, 0.0, 0.0});
  const double known_Nm2 = model_.model_Nm2();
  run(10000, {}, false);
  EXPECT_GT(model_.model_Nm2(), 2.0 * known_Nm2);
}

TEST_F(ResidualModelTest, FrictionNearRestIsUnknownAndTeachesNothing) {
  ResidualModel other(kResidualModelPrior, 0.7, kResidualModelDt_s);
  JointResidual in;
  in.part_Nm = {0.0, 0.0, 10.0, 0.5};
  in.torque_Nm = 6.0;
  in.unknown_friction_Nm = 7.0;
  for (int i = 0; i < 3000; ++i) other.step(in, kResidualModelDt_s, true);
  EXPECT_NEAR(other.torque_Nm(), 6.0, 1e-9);
  EXPECT_NEAR(other.rest_Nm2(), 49.0 / 3.0, 1e-9);
  in.unknown_friction_Nm = 0.0;  // it moves on: doubt fades within some milliseconds
  other.step(in, kResidualModelDt_s, false);
  EXPECT_GT(other.rest_Nm2(), 5.0);
  for (int i = 0; i < 30; ++i) other.step(in, kResidualModelDt_s, false);
  EXPECT_LT(other.rest_Nm2(), 1e-3);
}

TEST_F(ResidualModelTest, AJointWithoutAnyErrorStaysFinite) {
  ResidualModel perfect({}, 0.0, kResidualModelDt_s);
  for (int i = 0; i < 100; ++i) perfect.step({}, kResidualModelDt_s, true);
  EXPECT_EQ(perfect.torque_Nm(), 0.0);
  EXPECT_EQ(perfect.model_Nm2(), 0.0);
}

TEST_F(ResidualModelTest, ResetForgetsEverything) {
  run(2000, {0.2, 0.03, -0.03, 0.5});
  model_.reset();
  const JointResidual in = swing(k_, {}, 1.0);
  model_.step(in, kResidualModelDt_s, false);
  EXPECT_NEAR(model_.torque_Nm(), in.torque_Nm, 1e-12);
}

/// What one long cycle forgets is what many short ones do, whatever came before.
TEST_F(ResidualModelTest, UncertaintyComesBackWithTheTimeAndNotWithTheNumberOfCycles) {
  run(3000, {0.2, 0.03, -0.03, 0.5});
  ResidualModel other = model_;
  JointResidual in;
  in.part_Nm = {7.0, 80.0, 85.0, 0.5};
  in.unknown_friction_Nm = 3.0;
  model_.step(in, kResidualModelDt_s, false);
  other.step(in, kResidualModelDt_s, false);
  in.unknown_friction_Nm = 0.0;
  const double before_Nm2 = model_.model_Nm2();
  for (int i = 0; i < 8; ++i) model_.step(in, kResidualModelDt_s, false);
  other.step(in, 3 * kResidualModelDt_s, false);
  other.step(in, 5 * kResidualModelDt_s, false);
  EXPECT_GT(model_.model_Nm2(), before_Nm2);
  EXPECT_NEAR(other.model_Nm2(), model_.model_Nm2(), 1e-9 * model_.model_Nm2());
  EXPECT_NEAR(other.rest_Nm2(), model_.rest_Nm2(), 1e-9 * model_.rest_Nm2());
  EXPECT_NEAR(model_.rest_Nm2(), 3.0 * std::exp(-2.0 * 8e-3 / 4e-3), 1e-9);
}

}  // namespace
}  // namespace sprung
