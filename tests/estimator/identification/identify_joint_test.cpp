#include "estimator/identification/identify_joint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/estimator/identification/identification_fixture.h"
#include "tests/support/refusal.h"

namespace sprung::identification {
namespace {

using testing::HasSubstr;

/// Of the joint that every test here identifies.
constexpr double kInertia = 0.9, kGravity = 4.0, kCoulomb = 6.0, kViscous = 3.0;

/// 40 s at 100 Hz as a drive records it: encoder steps, noise on the torque.
RawSeries recording(std::uint64_t seed) {
  JointDataset motion = swinging_joint(4000);
  const JointModel joint({JointTerm::kViscous}, motion);
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joint.parameters().size()));
  for (std::size_t i = 0; i < joint.parameters().size(); ++i) {
    const std::string& name = joint.parameters()[i].name;
    if (name == "inertia") truth[static_cast<Eigen::Index>(i)] = kInertia;
    if (name == "gravity_sin") truth[static_cast<Eigen::Index>(i)] = kGravity;
    if (name == "coulomb") truth[static_cast<Eigen::Index>(i)] = kCoulomb;
    if (name == "viscous") truth[static_cast<Eigen::Index>(i)] = kViscous;
  }
  motion = simulated(joint, truth, motion, 0.4, seed);
  RawSeries out;
  out.gear_ratio = 100.0;
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    out.time_s.push_back(100.0 + motion.time_s[i]);
    out.position_rad.push_back(std::round(motion.position_rad[i] / 5e-7) * 5e-7);
    out.measured_torque.push_back(motion.measured_torque[i]);
  }
  return out;
}

Protocol protocol() {
  Protocol out;
  out.search.validation.blocks = 5;
  out.search.only = {{}, {JointTerm::kViscous}, {JointTerm::kViscous, JointTerm::kStribeck}};
  return out;
}

double parameter(const ModelResult& model, const std::string& name,
                 Eigen::VectorXd (*of)(const ModelResult&)) {
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return of(model)[static_cast<Eigen::Index>(i)];
  }
  return std::nan("");
}
double value(const ModelResult& model, const std::string& name) {
  return parameter(model, name, [](const ModelResult& m) { return m.fit.parameters; });
}
double error(const ModelResult& model, const std::string& name) {
  return parameter(model, name, [](const ModelResult& m) { return m.statistics.standard_error; });
}

TEST(IdentifyJoint, ChoosesTheModelThatMadeTheDataAndFindsItsParameters) {
  const JointResult found = identify_joint(recording(1), protocol());
  const ModelResult& chosen = found.models[found.chosen];
  EXPECT_EQ(chosen.model->name(), "viscous");
  EXPECT_NEAR(value(chosen, "inertia"), kInertia, 0.05 * kInertia);
  EXPECT_NEAR(value(chosen, "gravity_sin"), kGravity, 0.2);
  EXPECT_NEAR(value(chosen, "coulomb"), kCoulomb, 0.1);
  EXPECT_NEAR(value(chosen, "viscous"), kViscous, 0.2);
  EXPECT_NEAR(chosen.held_out.rms, 0.4, 0.02);
  EXPECT_GT(chosen.held_out.r2, 0.98);
  EXPECT_GT(found.models[0].held_out.rms, 0.5);
}

TEST(IdentifyJoint, IntervalsCoverTheTruthOverSixtySeeds) {
  Protocol p = protocol();
  p.search.only = {{JointTerm::kViscous}};
  p.search.validation.blocks = 2;
  int within = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const ModelResult model = identify_joint(recording(seed), p).models[0];
    const auto covered = [&](const char* name, double truth) {
      within += std::abs(value(model, name) - truth) < 1.96 * error(model, name);
      ++all;
    };
    covered("inertia", kInertia);
    covered("gravity_sin", kGravity);
    covered("coulomb", kCoulomb);
    covered("viscous", kViscous);
  }
  const double coverage = static_cast<double>(within) / all;
  EXPECT_GE(coverage, 0.85);
  EXPECT_LE(coverage, 1.0);
}

TEST(IdentifyJoint, TheScoredPartChoosesNothingAndMovesNoParameter) {
  const JointResult before = identify_joint(recording(1), protocol());
  RawSeries scrambled = recording(1);
  for (std::size_t i = 2000; i < 4000; ++i) {
    scrambled.position_rad[i] = noise(5, static_cast<Eigen::Index>(i));
    scrambled.measured_torque[i] = 50.0 * noise(6, static_cast<Eigen::Index>(i));
  }
  const JointResult after = identify_joint(scrambled, protocol());
  EXPECT_EQ(before.chosen, after.chosen);
  EXPECT_EQ(before.why, after.why);
  ASSERT_EQ(before.models.size(), after.models.size());
  for (std::size_t m = 0; m < before.models.size(); ++m) {
    EXPECT_EQ(before.models[m].fit.parameters, after.models[m].fit.parameters);
    EXPECT_EQ(before.models[m].statistics.standard_error.head(2),
              after.models[m].statistics.standard_error.head(2));
    EXPECT_EQ(before.models[m].validation.mean_square, after.models[m].validation.mean_square);
    EXPECT_NE(before.models[m].held_out.rms, after.models[m].held_out.rms);
  }
}

TEST(IdentifyJoint, PartsMayAlternateAndMayBeTheWrongWayRound) {
  Protocol p = protocol();
  p.train = {{0.5, 0.75}, {0.0, 0.25}};
  p.test = {{0.25, 0.5}, {0.75, 1.0}};
  const JointResult found = identify_joint(recording(2), p);
  EXPECT_EQ(found.training.size(), 2u);
  EXPECT_NEAR(static_cast<double>(found.models[1].train.samples), 2000.0, 4.0);
  EXPECT_NEAR(static_cast<double>(found.models[1].held_out.samples), 2000.0, 4.0);
  EXPECT_NEAR(found.models[1].held_out.rms, 0.4, 0.03);
}

TEST(IdentifyJoint, WindowIsCutOffAtTheRecordingsEnd) {
  Protocol p = protocol();
  p.window = {10.0, 1000.0};
  p.search.only = {{}};
  const JointResult found = identify_joint(recording(2), p);
  EXPECT_EQ(found.from_s, 10.0);
  EXPECT_NEAR(found.to_s, 39.99, 1e-6);
}

std::string refusal(const Protocol& p) {
  return test::refusal_of([&] { identify_joint(recording(1), p); });
}

TEST(IdentifyJoint, PartsThatMakeNoSenseAreRefused) {
  Protocol p = protocol();
  p.test = {{0.4, 1.0}};
  EXPECT_THAT(refusal(p), HasSubstr("overlap"));
  p.test = {{0.5, 1.2}};
  EXPECT_THAT(refusal(p), HasSubstr("fractions"));
  p = protocol();
  p.window = {50.0, 60.0};
  EXPECT_THAT(refusal(p), HasSubstr("the recording ends at"));
  p = protocol();
  p.train = {};
  EXPECT_THAT(refusal(p), HasSubstr("training part is empty"));
  p = protocol();
  p.train = {{0.0, 0.02}};
  EXPECT_THAT(refusal(p), HasSubstr("record longer"));
}

}  // namespace
}  // namespace sprung::identification
