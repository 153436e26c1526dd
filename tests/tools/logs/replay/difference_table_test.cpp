#include "tools/logs/replay/difference_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

FieldDifference field(const std::string& path, double difference) {
  return {path, "Nm", "1", "2", difference};
}

TEST(DifferenceTable, IsEmptyAtFirst) {
  const DifferenceTable table;
  EXPECT_FALSE(table.first());
  EXPECT_TRUE(table.by_count().empty());
}

TEST(DifferenceTable, RemembersTheFirst) {
  DifferenceTable table;
  table.add("A", 3, 0.003, {field("x", 1.0), field("y", 1.0)});
  table.add("B", 4, 0.004, {field("z", 1.0)});
  ASSERT_TRUE(table.first());
  EXPECT_EQ(table.first()->channel, "A");
  EXPECT_EQ(table.first()->seq, 3);
  EXPECT_EQ(table.first()->field.path, "x");
  EXPECT_EQ(table.first()->text("then", "now"), "A cycle 3 (0.003000 s): x 1 Nm then, 2 Nm now");
}

TEST(DifferenceTable, KeepsCountAndLargestOfEachField) {
  DifferenceTable table;
  table.add("A", 0, 0.0, {field("x", -1.0), field("y", 0.1)});
  table.add("A", 1, 0.1, {field("x", 0.5)});
  const FieldCourse& x = table.fields().at({"A", "x"});
  EXPECT_EQ(x.count, 2);
  EXPECT_DOUBLE_EQ(x.largest, 1.0);
  EXPECT_DOUBLE_EQ(x.largest_s, 0.0);
  EXPECT_EQ(table.by_count()[0].second, "x");
  EXPECT_TRUE(x.time_s.empty());  // no course was asked for
}

TEST(DifferenceTable, FieldsWithoutNumbersHaveNoLargest) {
  DifferenceTable table(true);
  table.add("A", 0, 0.0, {field("text", NAN)});
  EXPECT_TRUE(std::isnan(table.fields().at({"A", "text"}).largest));
}

TEST(DifferenceTable, SameFieldOfTwoChannelsIsTwoFields) {
  DifferenceTable table;
  table.add("A", 0, 0.0, {field("x", 1.0)});
  table.add("B", 0, 0.0, {field("x", 2.0)});
  EXPECT_EQ(table.fields().size(), 2u);
}

TEST(DifferenceTable, CourseIsThinnedAndKeepsItsEnds) {
  DifferenceTable table(true);
  constexpr int kCount = 50'000;
  for (int k = 0; k < kCount; ++k) table.add("A", k, 1e-3 * k, {field("x", k)});
  const FieldCourse& x = table.fields().at({"A", "x"});
  EXPECT_EQ(x.count, kCount);
  EXPECT_LE(x.time_s.size(), 4000u);
  EXPECT_GT(x.time_s.size(), 1000u);
  EXPECT_DOUBLE_EQ(x.time_s.front(), 0.0);
  EXPECT_NEAR(x.time_s.back(), 1e-3 * kCount, 1e-3 * 100);
  for (std::size_t i = 0; i < x.time_s.size(); ++i) EXPECT_NEAR(x.difference[i], 1e3 * x.time_s[i], 1e-6);
}

TEST(FirstDifference, OfAWholeMessageSaysSo) {
  const FirstDifference first{"A", 1, 0.0, {"", "", "no message", "joint_state_t, 9 bytes", NAN}};
  EXPECT_EQ(first.text("in the log", "now"),
            "A cycle 1 (0.000000 s): the message is no message in the log, joint_state_t, 9 bytes now");
}

}  // namespace
}  // namespace sprung
