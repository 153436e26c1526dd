#include "drivers/bridge/reference_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {

ActuatorConfig referenced(bool absolute_encoder) {
  ActuatorConfig out;
  out.offset_rad = 0.3;
  out.referenced = true;
  out.reference.absolute_encoder = absolute_encoder;
  return out;
}

void compare(ReferenceWatch& watch, double difference_rad, int cycles) {
  for (int k = 0; k < cycles; ++k) watch.compare(1.0, 1.0 + difference_rad);
}

NodeHealth shown(const ReferenceWatch& watch) {
  NodeHealth out;
  watch.show(out);
  return out;
}

TEST(ReferenceWatch, BeginsAsConfigured) {
  const ReferenceWatch watch(referenced(false));
  EXPECT_TRUE(watch.reference().known);
  EXPECT_EQ(shown(watch).reference_offset_rad, 0.3);
  EXPECT_EQ(shown(watch).reference_source, ReferenceSource::kConfigured);
  EXPECT_STREQ(watch.loss(), "");
}

TEST(ReferenceWatch, ACountThatPowerKeepsIsNotDoubted) {
  ReferenceWatch absolute(referenced(true)), incremental(referenced(false));
  absolute.doubt();
  incremental.doubt();
  EXPECT_TRUE(absolute.reference().known);
  EXPECT_FALSE(incremental.reference().known);
  EXPECT_STREQ(incremental.loss(), "reference lost: it may have restarted");
  EXPECT_TRUE(std::isnan(shown(incremental).reference_offset_rad));
}

TEST(ReferenceWatch, TheFirstReasonStaysUntilItIsFoundAnew) {
  ReferenceWatch watch(referenced(false));
  watch.lose("reference lost: encoder jumped");
  watch.doubt();
  EXPECT_STREQ(watch.loss(), "reference lost: encoder jumped");
  watch.set({0.7, true, ReferenceSource::kJig});
  EXPECT_STREQ(watch.loss(), "");
  EXPECT_EQ(shown(watch).reference_offset_rad, 0.7);
  EXPECT_EQ(shown(watch).reference_source, ReferenceSource::kJig);
}

TEST(ReferenceWatch, EncodersApartForTenCyclesInARowLoseIt) {
  ReferenceWatch watch(referenced(true));
  compare(watch, 0.06, 9);
  compare(watch, 0.04, 1);
  compare(watch, -0.06, 9);
  EXPECT_TRUE(watch.reference().known);
  EXPECT_FALSE(watch.apart());
  compare(watch, -0.06, 1);
  EXPECT_FALSE(watch.reference().known);
  EXPECT_TRUE(watch.apart());
  EXPECT_STREQ(watch.loss(), "reference lost: encoders disagree");
  watch.set({0.3, true, ReferenceSource::kLink});
  EXPECT_FALSE(watch.apart());
}

TEST(ReferenceWatch, AWholeTurnApartIsTheSamePlace) {
  ReferenceWatch watch(referenced(true));
  compare(watch, 2.0 * kTurn_rad + 0.01, 20);
  EXPECT_TRUE(watch.reference().known);
}

}  // namespace
}  // namespace sprung
