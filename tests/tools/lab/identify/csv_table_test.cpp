#include "tools/lab/identify/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "tests/support/refusal.h"

namespace sprung::identify {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::vector<double>> read(const std::string& text, const std::string& columns,
                                      char delimiter = 0) {
  std::istringstream in(text);
  return read_table(in, "data.csv", parse_columns(columns), {delimiter});
}

std::string refusal(const std::string& text, const std::string& columns) {
  return test::refusal_of<std::runtime_error>([&] { read(text, columns); });
}

const std::string kPlain = "time=1,position=3,current=2";

TEST(CsvTable, WithoutHeaderColumnsCountFromOne) {
  const auto values = read("0.0,1.5,-2\n0.1,+1.6,-2.5e-1\n", kPlain);
  EXPECT_THAT(values[0], ElementsAre(0.0, 0.1));
  EXPECT_THAT(values[1], ElementsAre(-2.0, -0.25));
  EXPECT_THAT(values[2], ElementsAre(1.5, 1.6));
}

TEST(CsvTable, HeaderGivesNamesAndNumbersStillWork) {
  const auto values = read("\xEF\xBB\xBF\"t\";\"current 1\";enc\r\n0;1;2\r\n1;3;4\r\n",
                           "time=1,position=enc*10,current=current 1");
  EXPECT_THAT(values[0], ElementsAre(0, 1));
  EXPECT_THAT(values[1], ElementsAre(20, 40));
  EXPECT_THAT(values[2], ElementsAre(1, 3));
}

TEST(CsvTable, TabsBlanksCommentsAndEmptyLines) {
  const auto values = read("# made by hand\n\n 0\t1 \t2\n#1\t1\t1\n 1\t3\t4\n", kPlain);
  EXPECT_THAT(values[2], ElementsAre(1, 3));
}

TEST(CsvTable, ColumnsCanBeSummed) {
  EXPECT_THAT(read("1,2,3\n4,5,6\n", "time=1,position=2,torque=2*2+3*-1")[2], ElementsAre(1.0, 4.0));
}

TEST(CsvTable, FirstRowWithNanIsNoHeader) {
  EXPECT_THAT(read("0,1,2,nan\n1,3,4,nan\n", kPlain)[2], ElementsAre(1, 3));
}

TEST(CsvTable, MistakesNameFileLineValueAndRemedy) {
  EXPECT_THAT(refusal("0,1,2\n1,x,4\n", kPlain),
              HasSubstr("data.csv:2: 'x' in column 2 (current) is no finite number; mend"));
  EXPECT_THAT(refusal("0,1,2\n\n1,nan,4\n", kPlain), HasSubstr("data.csv:3: 'nan'"));
  EXPECT_THAT(refusal("0,1,2\n1,2\n", kPlain),
              HasSubstr("data.csv:2: has 2 columns, position is column 3; is the line cut off"));
  EXPECT_THAT(refusal("0,1,2\n", "time=1,position=9,current=2"),
              HasSubstr("no column 9 for position: there are 3"));
  EXPECT_THAT(refusal("0,1,2\n", "time=1,position=q,current=2"),
              HasSubstr("there is no header line: give its number"));
  EXPECT_THAT(refusal("t,q,i\n0,1,2\n", "time=t,position=angle,current=i"), HasSubstr("there are t, q, i"));
  EXPECT_THAT(refusal("", kPlain), HasSubstr("holds no line"));
  EXPECT_THAT(refusal("t,q,i\n", kPlain), HasSubstr("no rows"));
}

TEST(CsvTable, AFileThatIsNotThereIsNamed) {
  EXPECT_THROW(read_csv("/nowhere/x.csv", parse_columns(kPlain), {}), std::runtime_error);
}

}  // namespace
}  // namespace sprung::identify
