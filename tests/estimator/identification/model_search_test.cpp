#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "estimator/identification/identify_joint.h"
#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

using T = JointTerm;

/// A joint with inertia, gravity, Coulomb and viscous friction, and with a ripple of the motor angle where
/// asked for.
std::vector<FitPiece> joint(bool ripple) {
  JointDataset data = swinging_joint(1600);
  data.gear_ratio = 100.0;
  const JointTerms terms = ripple ? JointTerms{T::kViscous, T::kRipple2} : JointTerms{T::kViscous};
  data.measured_torque = Eigen::VectorXd::LinSpaced(1600, -10.0, 10.0);
  const JointModel model(terms, data);
  Eigen::VectorXd truth(static_cast<Eigen::Index>(model.parameters().size()));
  for (Eigen::Index i = 0; i < truth.size(); ++i) {
    const std::string& name = model.parameters()[i].name;
    truth[i] = name == "inertia" ? 0.8 : name == "coulomb" ? 6.0 : name == "viscous" ? 3.0 : 1.5;
  }
  return {whole(simulated(model, truth, data, 0.3, 11))};
}

SearchOptions quick() {
  SearchOptions out;
  out.validation.blocks = 4;
  return out;
}

bool tried(const std::vector<TriedModel>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const TriedModel& t) { return t.model->name() == name; });
}

TEST(ModelSearch, NamedModelsAreAlwaysCompared) {
  const auto found = search_models(joint(false), quick());
  for (const JointTerms& terms : named_models()) EXPECT_TRUE(tried(found, name(terms))) << name(terms);
}

TEST(ModelSearch, AddsTheTermThatTheDataHave) {
  const auto found = search_models(joint(true), quick());
  const auto best = std::max_element(
      found.begin(), found.end(),
      [](const TriedModel& a, const TriedModel& b) { return a.validation.r2() < b.validation.r2(); });
  EXPECT_TRUE(has(best->model->terms(), T::kViscous));
  EXPECT_TRUE(has(best->model->terms(), T::kRipple2));
  EXPECT_TRUE(tried(found, "viscous+ripple_2"));
}

TEST(ModelSearch, StaysWithinItsParameters) {
  SearchOptions options = quick();
  options.most_parameters = 7;
  for (const TriedModel& model : search_models(joint(true), options)) {
    const auto named = named_models();
    const bool is_named = std::find(named.begin(), named.end(), model.model->terms()) != named.end();
    EXPECT_TRUE(is_named || free_parameters(*model.model) <= 7) << model.model->name();
  }
}

TEST(ModelSearch, OnlyTheModelsAskedForAreTried) {
  SearchOptions options = quick();
  options.only = {{}, {T::kViscous}};
  std::vector<std::string> seen;
  const auto found = search_models(joint(true), options,
                                   [&](const std::string& name) { seen.push_back(name); });
  EXPECT_EQ(found.size(), 2u);
  EXPECT_THAT(seen, testing::ElementsAre("coulomb", "viscous"));
}

TEST(ModelSearch, NoDataAreRefused) { EXPECT_THROW(search_models({}, quick()), std::invalid_argument); }

}  // namespace
}  // namespace sprung::identification
