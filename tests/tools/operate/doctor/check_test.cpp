#include "tools/operate/doctor/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/enumerators.h"

namespace sprung::doctor {
namespace {

using testing::HasSubstr;

TEST(Verdicts, EveryOneHasItsOwnName) { test::expect_own_names<Verdict>(); }

TEST(Check, WorstCounts) {
  EXPECT_EQ(worst({}), Verdict::kPass);
  EXPECT_EQ(worst({pass("a", "b"), warn("c", "d", "e"), pass("f", "g")}), Verdict::kWarn);
  EXPECT_EQ(worst({fail("a", "b", "c"), warn("c", "d", "e")}), Verdict::kFail);
}

TEST(Check, TextNamesVerdictFindingAndRemedy) {
  const std::string text = as_text({pass("ttl", "ttl=0"), fail("disk", "full", "rm x")});
  EXPECT_THAT(text, HasSubstr("pass  ttl "));
  EXPECT_THAT(text, HasSubstr("fail  disk "));
  EXPECT_THAT(text, HasSubstr("mend it: rm x"));
  EXPECT_THAT(text, HasSubstr("1 pass, 0 warn, 1 fail"));
}

TEST(Check, JsonIsOneObject) {
  const auto json = nlohmann::json::parse(as_json({warn("kernel", "found \"x\"", "do y")}));
  EXPECT_EQ(json["verdict"], "warn");
  EXPECT_EQ(json["checks"][0]["found"], "found \"x\"");
  EXPECT_EQ(json["checks"][0]["remedy"], "do y");
}

}  // namespace
}  // namespace sprung::doctor
