#include "tools/lab/campaign/separate.h"

#include <gtest/gtest.h>

namespace sprung::campaign {
namespace {

TEST(SeparateRows, RunThatDiffersOrFailedIsCounted) {
  SeparateRun same, differs, failed;
  same.cycles = differs.cycles = 100;
  differs.first_difference = 7;
  failed.failure = "the machine is overloaded";
  EXPECT_TRUE(separate_rows({same})[2].ok());
  const auto rows = separate_rows({same, differs, failed});
  EXPECT_EQ(rows[0].value, 3.0);
  EXPECT_EQ(rows[1].value, 200.0);
  EXPECT_EQ(rows[2].value, 2.0);
  EXPECT_FALSE(rows[2].ok());
}

}  // namespace
}  // namespace sprung::campaign
