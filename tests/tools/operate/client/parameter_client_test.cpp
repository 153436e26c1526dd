#include "tools/operate/client/parameter_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::Not;

Parameter sample(const std::string& name, double file) {
  Parameter out;
  out.name = name;
  out.unit = "N/m";
  out.meaning = "spring";
  out.file = file;
  out.least = 0.5 * file;
  out.most = 2.0 * file;
  return out;
}

TEST(ParameterTable, ShowsValueRangeAndWhatRobotYamlSays) {
  const std::vector<Parameter> all{sample("soft", 100.0), sample("hard", 3000.0)};
  const std::string text = parameter_table(all, {100.0, 4000.0}, false);
  EXPECT_THAT(text, HasSubstr("soft"));
  EXPECT_THAT(text, HasSubstr("4000 N/m"));
  EXPECT_THAT(text, HasSubstr("1500 to 6000"));
  EXPECT_THAT(text, HasSubstr("robot.yaml: 3000. spring"));
  const std::string changed = parameter_table(all, {100.0, 4000.0}, true);
  EXPECT_THAT(changed, Not(HasSubstr("soft")));
  EXPECT_THAT(changed, HasSubstr("hard"));
}

}  // namespace
}  // namespace sprung
