#include "model/friction/friction_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/model/friction/friction_examples.h"
#include "tests/model/friction/parameter_sets.h"

namespace sprung {
namespace {

TEST(FrictionParametersTest, TableIsInOrderOfTheIndexAndNamesAreUnique) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kFrictionParameters; ++i) {
    const FrictionParameterInfo& row = friction_parameter_table()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.index), i);
    EXPECT_EQ(&info(row.index), &row);
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_LE(row.low, row.off) << row.name;
    EXPECT_GE(row.high, row.off) << row.name;
  }
}

TEST(FrictionParametersTest, DefaultsAreTheTablesOffValues) {
  const FrictionVector vector = to_vector(FrictionParameters{});
  for (const FrictionParameterInfo& row : friction_parameter_table())
    EXPECT_EQ(vector[static_cast<std::size_t>(row.index)], row.off) << row.name;
}

TEST(FrictionParametersTest, VectorAndStructHoldTheSame) {
  FrictionVector vector{};
  for (std::size_t i = 0; i < vector.size(); ++i) vector[i] = 0.1 * static_cast<double>(i + 1);
  const FrictionParameters p = test::from_vector(vector, 31.0);
  EXPECT_EQ(to_vector(p), vector);
  EXPECT_EQ(p.reference_temperature_C, 31.0);
  EXPECT_EQ(p.stribeck_speed_rad_s, vector[static_cast<std::size_t>(FrictionParameter::kStribeckSpeed)]);
}

TEST(FrictionParametersTest, BreakawayIsCoulombPlusStribeck) {
  EXPECT_DOUBLE_EQ(breakaway_Nm(full_friction()), 4.3);
}

TEST(FrictionParametersTest, CoulombAloneHasEveryOtherTermOff) {
  EXPECT_EQ(coulomb_alone(1.79).coulomb_Nm, 1.79);
  EXPECT_EQ(to_vector(restricted(coulomb_alone(1.79), FrictionModelKind::kCoulomb)),
            to_vector(coulomb_alone(1.79)));
}

TEST(FrictionParametersTest, EachModelHoldsTheOneBefore) {
  for (std::size_t k = 1; k < kFrictionModels.size(); ++k) {
    int added = 0;
    for (const FrictionParameterInfo& row : friction_parameter_table()) {
      if (has(kFrictionModels[k - 1], row.index)) {
        EXPECT_TRUE(has(kFrictionModels[k], row.index)) << row.name;
      }
      if (has(kFrictionModels[k], row.index)) {
        EXPECT_TRUE(allows(kFrictionModels[k], row.index)) << row.name;
        added += has(kFrictionModels[k - 1], row.index) ? 0 : 1;
      }
    }
    EXPECT_GT(added, 0) << name(kFrictionModels[k]);
  }
}

TEST(FrictionParametersTest, ShapesOfATermAreAllowedFromItsModelOnAndNeverItsOwn) {
  EXPECT_FALSE(allows(FrictionModelKind::kCoulomb, FrictionParameter::kViscousTemperature));
  EXPECT_TRUE(allows(FrictionModelKind::kViscous, FrictionParameter::kViscousTemperature));
  EXPECT_FALSE(has(FrictionModelKind::kPresliding, FrictionParameter::kViscousTemperature));
  EXPECT_FALSE(allows(FrictionModelKind::kViscous, FrictionParameter::kStribeckExponent));
}

TEST(FrictionParametersTest, RestrictedSwitchesOffWhatTheModelDoesNotKnow) {
  const FrictionParameters p = restricted(full_friction(), FrictionModelKind::kViscous);
  EXPECT_EQ(p.coulomb_Nm, 3.3);
  EXPECT_EQ(p.viscous_exponent, 0.8);
  EXPECT_EQ(p.stribeck_Nm, 0.0);
  EXPECT_EQ(p.stribeck_exponent, 2.0);
  EXPECT_EQ(p.load_share_driven, 0.0);
  EXPECT_EQ(p.presliding_rad, 0.0);
  EXPECT_EQ(to_vector(restricted(full_friction(), FrictionModelKind::kPresliding)),
            to_vector(full_friction()));
}

TEST(FrictionParametersTest, ModelsAreFoundByTheirNames) {
  for (const FrictionModelKind kind : kFrictionModels)
    EXPECT_EQ(value_named<FrictionModelKind>(name(kind)), kind);
  EXPECT_EQ(value_named<FrictionModelKind>("lugre"), std::nullopt);
}

}  // namespace
}  // namespace sprung
