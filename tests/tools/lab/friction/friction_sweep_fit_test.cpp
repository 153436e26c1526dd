#include "tools/lab/friction/friction_sweep_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/friction/friction_law.h"
#include "simulation/hash_noise.h"
#include "tests/support/enumerators.h"

namespace sprung {
namespace {

using T = identification::JointTerm;

const BenchLimits kKnee{0.07, 2.53, 4.36, 133.0, 23.0};
constexpr double kWeight_Nm = 0.5;

/// Facts papers C4: the N = 50 joint.
FrictionParameters n50() {
  FrictionParameters law;
  law.coulomb_Nm = 3.3;
  law.stribeck_Nm = 1.0;
  law.stribeck_speed_rad_s = 0.15;
  law.viscous_Nm_s_rad = 1.3;
  law.load_share_driving = 0.063;
  law.load_share_driven = 0.08;
  law.asymmetry = 0.04;
  return law;
}

/// What a perfect bench would measure, plus noise sample by sample.
SweepRecording made(SweepProtocol protocol, const FrictionParameters& law, double noise_Nm,
                    std::uint64_t seed) {
  const SweepPlan plan = sweep_plan(protocol, kKnee);
  SweepRecording out;
  out.protocol = protocol;
  out.gear_ratio = 50.0;
  std::int64_t count = 0;
  for (const SweepPass& pass : plan.passes) {
    RecordedPass r;
    r.pass = pass;
    r.velocity_rad_s = pass.direction() * pass.speed_rad_s;
    const SteadySpan span = steady_span(pass, plan.mirrored);
    for (std::size_t i = 0; i < plan.samples_a_pass; ++i) {
      const double t = span.from_s + (span.to_s - span.from_s) * static_cast<double>(i) /
                                         static_cast<double>(plan.samples_a_pass - 1);
      const double q = pass.from_rad +
                       r.velocity_rad_s * (t - 0.5 * pass.speed_rad_s / pass.acceleration_rad_s2);
      const double load = -pass.load_Nm + kWeight_Nm * std::sin(q);
      r.time_s.push_back(t);
      r.position_rad.push_back(q);
      r.motor_torque_Nm.push_back(load + friction_torque_Nm(law, {r.velocity_rad_s, load}) +
                                  noise_Nm * sim::hash_noise(seed, 1, count++));
    }
    out.passes.push_back(r);
  }
  return out;
}

TEST(SweepPointsTest, EveryOneHasItsOwnName) { test::expect_own_names<SweepPoints>(); }

TEST(FrictionSweepFit, NoiseFreeSweepsGiveTheLawBack) {
  const SweepRecording recording = made(SweepProtocol::kLoaded, n50(), 0.0, 1);
  const SweepFit fit = fit_sweep(recording, SweepPoints::kBoth,
                                 {T::kViscous, T::kStribeck, T::kLoad, T::kAsymmetry});
  const FrictionParameters found = fit.model->friction(fit.fit.parameters);
  EXPECT_NEAR(found.coulomb_Nm, 3.3, 1e-3);
  EXPECT_NEAR(found.stribeck_Nm, 1.0, 1e-3);
  EXPECT_NEAR(found.stribeck_speed_rad_s, 0.15, 1e-3);
  EXPECT_NEAR(found.viscous_Nm_s_rad, 1.3, 1e-3);
  EXPECT_NEAR(found.load_share_driving, 0.063, 1e-4);
  EXPECT_NEAR(found.load_share_driven, 0.08, 1e-4);
  EXPECT_NEAR(found.asymmetry, 0.04, 1e-4);
  EXPECT_NEAR(parameter(fit, "gravity_sin").value, kWeight_Nm, 1e-3);
  EXPECT_GT(fit.score.r2, 0.999999);
}

/// Facts papers C4: additive noise of 0.40 Nm, one direction, speeds uniform in 0.02-4 rad/s gives 0.930.
TEST(FrictionSweepFit, S1sFigureComesFromItsProtocolAndNoise) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const SweepRecording recording = made(SweepProtocol::kS1, n50(), 0.40, seed);
    const identification::JointTerms equation5 = {T::kViscous, T::kStribeck};
    EXPECT_NEAR(fit_sweep(recording, SweepPoints::kForward, equation5).score.r2, 0.93, 0.02) << seed;
    EXPECT_GT(fit_sweep(recording, SweepPoints::kBoth, equation5).score.r2, 0.985) << seed;
    EXPECT_GT(fit_sweep(recording, SweepPoints::kForwardMeans, equation5).score.r2, 0.99) << seed;
  }
}

TEST(FrictionSweepFit, TheLoadTermIsSeenOnlyUnderLoad) {
  FrictionParameters strong = n50();
  strong.load_share_driving = 0.16;
  strong.load_share_driven = 0.18;
  const SweepRecording recording = made(SweepProtocol::kLoaded, strong, 0.40, 1);
  const SweepFit without = fit_sweep(recording, SweepPoints::kBoth, {T::kViscous, T::kStribeck});
  const SweepFit with = fit_sweep(recording, SweepPoints::kBoth, {T::kViscous, T::kStribeck, T::kLoad});
  EXPECT_LT(without.held_out.r2, 0.97);
  EXPECT_GT(with.held_out.r2, 0.98);
  EXPECT_EQ(with.held_out.samples, with.score.samples / 2);
}

TEST(FrictionSweepFit, StandardErrorsCoverTheTruth) {
  FrictionParameters law = n50();
  law.load_share_driving = law.load_share_driven = 0.0;
  int within = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SweepFit fit = fit_sweep(made(SweepProtocol::kS1, law, 0.40, seed), SweepPoints::kBoth,
                                   {T::kViscous, T::kStribeck, T::kAsymmetry});
    for (const auto& [name, truth] : {std::pair{"viscous", 1.3}, std::pair{"coulomb", 3.3}}) {
      const Estimate e = parameter(fit, name);
      ASSERT_GT(e.standard_error, 0.0);
      within += std::abs(e.value - truth) < 2.5 * e.standard_error ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GE(within, all - 2);
}

TEST(FrictionSweepFit, S0sMeanOfBothDirectionsIsFreeOfWeight) {
  FrictionParameters coulomb;
  coulomb.coulomb_Nm = 1.79;
  const SweepRecording recording = made(SweepProtocol::kS0, coulomb, 0.0, 1);
  const SweepFit fit = fit_sweep(recording, SweepPoints::kMagnitudes, {});
  EXPECT_EQ(fit.points.size(), recording.passes.size() / 2);
  EXPECT_NEAR(parameter(fit, "coulomb").value, 1.79, 1e-6);
  for (const FrictionPoint& point : fit.points) EXPECT_NEAR(point.measured_Nm, 1.79, 1e-6);
}

TEST(FrictionSweepFit, AsymmetryAndLoadAreOnlyTriedWhereTheDataShowThem) {
  EXPECT_EQ(sweep_models(made(SweepProtocol::kS1, n50(), 0.0, 1), SweepPoints::kForward).size(), 3u);
  EXPECT_EQ(sweep_models(made(SweepProtocol::kLoaded, n50(), 0.0, 1), SweepPoints::kBoth).size(), 6u);
}

TEST(FrictionSweepFit, AnUnknownParameterIsNotANumber) {
  const SweepFit fit = fit_sweep(made(SweepProtocol::kS0, n50(), 0.0, 1), SweepPoints::kMagnitudes, {});
  EXPECT_TRUE(std::isnan(parameter(fit, "viscous").value));
}

TEST(FrictionSweepFit, ARecordingWithoutPassesIsRefused) {
  EXPECT_THROW((void)fit_sweep({}, SweepPoints::kBoth, {}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
