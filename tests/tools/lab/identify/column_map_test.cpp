#include "tools/lab/identify/column_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/refusal.h"

namespace sprung::identify {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  return test::refusal_of([&] { parse_columns(text); });
}

TEST(ColumnMap, ReadsNumbersNamesFactorsAndSums) {
  const auto columns = parse_columns("time=1,position=enc_3*3.7e-7,torque=6*-0.8735+fts_5*-1");
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].signal, "time");
  EXPECT_EQ(columns[0].terms[0].column, "1");
  EXPECT_EQ(columns[0].terms[0].factor, 1.0);
  EXPECT_EQ(columns[1].terms[0].column, "enc_3");
  EXPECT_EQ(columns[1].terms[0].factor, 3.7e-7);
  ASSERT_EQ(columns[2].terms.size(), 2u);
  EXPECT_EQ(columns[2].terms[0].factor, -0.8735);
  EXPECT_EQ(columns[2].terms[1].column, "fts_5");
  EXPECT_EQ(columns[2].terms[1].factor, -1.0);
}

TEST(ColumnMap, MistakesAreNamedWithAnExample) {
  EXPECT_THAT(refusal("time=1,position=2"), HasSubstr("one of 'current' (A) and 'torque'"));
  EXPECT_THAT(refusal("time=1,position=2,current=3,torque=4"), HasSubstr("one of"));
  EXPECT_THAT(refusal("position=2,current=3"), HasSubstr("'time' is missing; for example"));
  EXPECT_THAT(refusal("time=1,time=2,position=2,current=3"), HasSubstr("'time' is given twice"));
  EXPECT_THAT(refusal("time=1,angle=2,current=3"),
              HasSubstr("unknown signal 'angle'; known are time, position"));
  EXPECT_THAT(refusal("time=1,position=2*x,current=3"), HasSubstr("'x' in '2*x' is no factor"));
  EXPECT_THAT(refusal("time=1,position=,current=3"), HasSubstr("names no column"));
  EXPECT_THAT(refusal("time"), HasSubstr("'time' is no signal=column"));
}

}  // namespace
}  // namespace sprung::identify
