#include "tools/station/page/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

namespace sprung::station {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Page, HasEverythingInItAndAsksNobody) {
  const std::string page = make_page({{"title", "a jump"}}, "QUJD");
  EXPECT_THAT(page, HasSubstr("<title>a jump</title>"));
  EXPECT_THAT(page, HasSubstr("id=\"data\">QUJD</script>"));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  for (const char* module :
       {"three", "uplot", "orbit_controls", "app", "source", "ground", "robot_view", "shapes", "sharpness"})
    EXPECT_THAT(page, HasSubstr("data-module=\"" + std::string(module) + "\"")) << module;
  EXPECT_THAT(page, Not(HasSubstr("src=\"")));
  EXPECT_THAT(page, Not(HasSubstr("<link rel=\"stylesheet\"")));
}

TEST(Page, NoTextOfALogEndsItsScripts) {
  const nlohmann::json config{{"title", "</title><script>alert(1)</script>"}, {"notes", {"</script><b>"}}};
  const std::string page = make_page(config, "");
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("</script><b>")));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
}

TEST(Page, TextThatIsNoUtf8IsShownAllTheSame) {
  EXPECT_THAT(make_page({{"title", "log \xff"}}, ""), HasSubstr("id=\"config\">"));
}

}  // namespace
}  // namespace sprung::station
