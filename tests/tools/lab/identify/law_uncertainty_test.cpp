#include "tools/lab/identify/law_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/tools/lab/identify/identify_sample.h"
#include "tools/lab/identify/fragment.h"

namespace sprung::identify {
namespace {

using identification::ModelResult;

class LawUncertainty : public testing::Test {
 protected:
  IdentifiedJoint joint_ = sample_joint(sample_series({}, 0.0));
  ModelResult model_ = joint_.chosen();
  const std::vector<identification::FitPiece>& recorded() const { return joint_.result.training; }
  Eigen::Index place(const std::string& name) const {
    const auto& all = model_.model->parameters();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].name == name) return static_cast<Eigen::Index>(i);
    }
    throw std::invalid_argument(name);
  }
  /// Nothing is unsure but what a test says.
  void be_sure() {
    model_.statistics.standard_error.setZero();
    model_.statistics.correlation.setIdentity();
  }
};

TEST_F(LawUncertainty, GoodFitIsWorthTheDayToDaySpread) {
  EXPECT_LT(fitted_law_share(model_, recorded()), 0.02);
  EXPECT_NEAR(law_uncertainty(model_, recorded(), 0.15), 0.15, 0.005);
}

TEST_F(LawUncertainty, CoulombsErrorCountsAsAShareOfTheLaw) {
  be_sure();
  const double coulomb_Nm = model_.fit.parameters[place("coulomb")];
  model_.statistics.standard_error[place("coulomb")] = 0.3 * coulomb_Nm;
  const double share = fitted_law_share(model_, recorded());
  EXPECT_LT(share, 0.3) << "viscous friction is known";
  EXPECT_GT(share, 0.15);
  EXPECT_NEAR(law_uncertainty(model_, recorded(), 0.4), std::hypot(0.4, share), 1e-12);
}

TEST_F(LawUncertainty, ErrorsThatMakeUpForEachOtherCountLess) {
  be_sure();
  const Eigen::Index coulomb = place("coulomb"), viscous = place("viscous");
  model_.statistics.standard_error[coulomb] = 1.0;
  model_.statistics.standard_error[viscous] = 2.0;
  const double apart = fitted_law_share(model_, recorded());
  model_.statistics.correlation(coulomb, viscous) = model_.statistics.correlation(viscous, coulomb) = -0.95;
  EXPECT_LT(fitted_law_share(model_, recorded()), 0.7 * apart);
}

TEST_F(LawUncertainty, ParameterThatTheDataDoNotShowCountsWhole) {
  be_sure();
  model_.statistics.standard_error[place("viscous")] = std::numeric_limits<double>::quiet_NaN();
  const double hidden = fitted_law_share(model_, recorded());
  model_.statistics.standard_error[place("viscous")] = model_.fit.parameters[place("viscous")];
  EXPECT_NEAR(hidden, fitted_law_share(model_, recorded()), 1e-12);
  EXPECT_GT(hidden, 0.1);
}

TEST_F(LawUncertainty, IsNotTheResidual) {
  const JointConfig known = {};
  model_.held_out.rms = 100.0;
  joint_.result.models[joint_.result.chosen] = model_;
  const JointConfig found = identified_config(joint_, known, sample_provenance(), {0.2});
  EXPECT_NEAR(found.uncertainty.friction, 0.2, 0.01);
}

TEST(ThermalInRoom, KeepsWhatIsKnownOfTheGearAndTakesTheRoomsTemperature) {
  const ThermalParameters known = thermal_in_room({0.8, 600.0, 24.0}, 30.0);
  EXPECT_EQ(known.resistance_K_W, 0.8);
  EXPECT_EQ(known.time_constant_s, 600.0);
  EXPECT_EQ(known.ambient_C, 30.0);
  EXPECT_LT(known.ambient_std_K, ThermalParameters{}.ambient_std_K);
  EXPECT_GT(thermal_in_room({}, 30.0).time_constant_s, 0.0);
}

TEST_F(LawUncertainty, WithoutFrictionNothingIsKnown) {
  model_.fit.parameters[place("coulomb")] = 0.0;
  model_.fit.parameters[place("viscous")] = 0.0;
  EXPECT_EQ(law_uncertainty(model_, recorded(), 0.15), 10.0);
}

}  // namespace
}  // namespace sprung::identify
