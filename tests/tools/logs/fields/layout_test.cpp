#include "tools/logs/fields/layout.h"

#include <gtest/gtest.h>

#include "sprung_msgs/sim_control_t.hpp"
#include "tests/signals/message_bytes.h"
#include "tools/logs/fields/type_table.h"

namespace sprung::fields {
namespace {

std::shared_ptr<const Layout> sim_control_layout() {
  const auto bytes = test::encoded(sprung_msgs::sim_control_t{});
  Fault fault = Fault::kTooShort;
  auto layout = build_layout(*TypeTable::sprung().by_name("sim_control_t"), bytes.data(), bytes.size(),
                             fault);
  EXPECT_EQ(fault, Fault::kNone);
  return layout;
}

TEST(Layout, FieldsStandAsTheyAreEncoded) {
  const auto layout = sim_control_layout();
  ASSERT_NE(layout, nullptr);
  EXPECT_EQ(layout->fields[0].path, "session");
  EXPECT_EQ(layout->fields[3].path, "apply_at_seq");
  EXPECT_EQ(layout->fields[4].path, "wrench[0]");
  EXPECT_EQ(layout->fields[4].offset, 32u);
  EXPECT_EQ(layout->find("wrench[5]"), 9);
  EXPECT_EQ(layout->find("wrench"), Layout::kNone);
}

TEST(Layout, UnitsMayDifferWithinAList) {
  const auto layout = sim_control_layout();
  EXPECT_EQ(layout->fields[6].unit, "N");
  EXPECT_EQ(layout->fields[7].unit, "Nm");
}

TEST(Layout, KnowsWhereTheStampIs) {
  const auto layout = sim_control_layout();
  EXPECT_EQ(layout->session, 0);
  EXPECT_EQ(layout->utime, 1);
  EXPECT_EQ(layout->seq, 2);
}

TEST(Layout, IntegersAreSignExtended) {
  const std::uint8_t bytes[8] = {0xFF, 0xFE, 0xFD, 0xFC, 1, 2, 3, 4};
  EXPECT_EQ(read_integer(Wire::kInt8, bytes), -1);
  EXPECT_EQ(read_integer(Wire::kByte, bytes), 255);
  EXPECT_EQ(read_integer(Wire::kInt16, bytes), -2);
  EXPECT_EQ(read_integer(Wire::kInt32, bytes), -0x00010204);
  EXPECT_EQ(read_integer(Wire::kInt64, bytes + 0), static_cast<std::int64_t>(0xFFFEFDFC01020304ULL));
}

TEST(Layout, EveryFaultHasItsOwnName) {
  for (int a = 0; a <= static_cast<int>(Fault::kTrailing); ++a) {
    EXPECT_STRNE(name(static_cast<Fault>(a)), "unknown");
    for (int b = 0; b < a; ++b) EXPECT_STRNE(name(static_cast<Fault>(a)), name(static_cast<Fault>(b)));
  }
}

}  // namespace
}  // namespace sprung::fields
