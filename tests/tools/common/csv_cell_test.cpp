#include "tools/common/csv_cell.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

std::string cell(const char* text) {
  std::string out = "1,";
  append_cell(text, out);
  return out;
}

TEST(CsvCell, StandsInQuotesOnlyWhereItNeedsThem) {
  EXPECT_EQ(cell("0.5"), "1,0.5");
  EXPECT_EQ(cell(""), "1,");
  EXPECT_EQ(cell("a,b"), "1,\"a,b\"");
  EXPECT_EQ(cell("say \"no\""), "1,\"say \"\"no\"\"\"");
  EXPECT_EQ(cell("two\nlines"), "1,\"two\nlines\"");
}

}  // namespace
}  // namespace sprung
