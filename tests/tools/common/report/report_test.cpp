#include "tools/common/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/paths.h"
#include "tests/tools/common/report/report_sample.h"

namespace sprung::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string html_of(Section section) {
  Report report{"Title"};
  report.sections = {std::move(section)};
  return to_html(report);
}

std::string source(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(test::source_dir() + "/tools/common/report/" + file).rdbuf();
  return text.str();
}

TEST(ToHtml, TitleSubtitleCommandAndTextAreEscaped) {
  Report report{"A < B", "x & y", "sprung --name '<b>'"};
  report.sections = {{"H > G", {"1 < 2"}}};
  const std::string html = to_html(report);
  EXPECT_THAT(html, HasSubstr("<title>A &lt; B</title>"));
  EXPECT_THAT(html, HasSubstr("<h1>A &lt; B</h1>"));
  EXPECT_THAT(html, HasSubstr("<p class=\"subtitle\">x &amp; y</p>"));
  EXPECT_THAT(html, HasSubstr("<code>sprung --name &#39;&lt;b&gt;&#39;</code>"));
  EXPECT_THAT(html, HasSubstr(">H &gt; G</h2>"));
  EXPECT_THAT(html, HasSubstr("<p class=\"text\">1 &lt; 2</p>"));
}

TEST(ToHtml, NothingComesFromANetwork) {
  std::string html = to_html(sample_report(100));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  for (const char* reference : {"src=\"", "href=\"http", "@import", "url("})
    EXPECT_THAT(html, Not(HasSubstr(reference)));
}

TEST(ToHtml, ScriptAndStyleArriveAsTheyAreInTheSources) {
  const std::string html = to_html(sample_report(100));
  EXPECT_THAT(html, HasSubstr(source("report.js")));
  EXPECT_THAT(html, HasSubstr(source("report.css")));
  EXPECT_THAT(html, HasSubstr("Released under the MIT License"));
}

TEST(ToHtml, WithoutPlotsThereIsNoScript) {
  EXPECT_THAT(html_of({"Only text", {"words"}}), Not(HasSubstr("<script")));
}

TEST(ToHtml, TheSameReportGivesTheSameBytes) {
  EXPECT_EQ(to_html(sample_report(5000)), to_html(sample_report(5000)));
}

TEST(ToHtml, ATenMinuteLogIsLight) { EXPECT_LT(to_html(sample_report(600000)).size(), 800000u); }

TEST(ToHtml, PlotsAreNumberedAcrossSections) {
  Report report{"Title"};
  report.sections = {{"a", {}, {}, {Plot{}, Plot{}}}, {"b", {}, {}, {Plot{}}}};
  const std::string html = to_html(report);
  for (const char* canvas : {"data-plot=\"0\"", "data-plot=\"1\"", "data-plot=\"2\""})
    EXPECT_THAT(html, HasSubstr(canvas));
}

TEST(ToHtml, LongReportsHaveContents) {
  Report report{"Title"};
  report.sections = {{"one"}, {"two"}};
  EXPECT_THAT(to_html(report), Not(HasSubstr("<nav>")));
  report.sections.push_back({"three"});
  EXPECT_THAT(to_html(report), HasSubstr("<a href=\"#section3\">three</a>"));
  EXPECT_THAT(to_html(report), HasSubstr("<section id=\"section3\">"));
}

TEST(Tables, ColumnsOfNumbersAreFlushRight) {
  const std::string html = html_of({"s", {}, {{"t", {"name", "RMS (Nm)"}, {{"knee", 3.5}, {"hip", "-"}}}}});
  EXPECT_THAT(html, HasSubstr("<th>name</th><th class=\"number\">RMS (Nm)</th>"));
  EXPECT_THAT(html, HasSubstr("<td>knee</td><td class=\"number\">3.5</td>"));
}

TEST(Tables, MarksAndEscapes) {
  const std::string html = html_of(
      {"s", {}, {{"t", {"a", "b"}, {{{"<i>", Mark::kBad}, {1, Mark::kGood}}}, "note & more"}}});
  EXPECT_THAT(html, HasSubstr("<td class=\" bad\">&lt;i&gt;</td><td class=\"number good\">1</td>"));
  EXPECT_THAT(html, HasSubstr("<p class=\"note\">note &amp; more</p>"));
}

TEST(Tables, FoldedOnesOpenOnAClick) {
  EXPECT_THAT(html_of({"s", {}, {{"Parameters", {"a"}, {}, "", true}}}),
              HasSubstr("<details>\n<summary class=\"title\">Parameters</summary>"));
}

TEST(Tables, RowsOfAnotherLengthAreRefusedByName) {
  try {
    html_of({"s", {}, {{"scores", {"a", "b"}, {{"only one"}}}}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "table \"scores\": a row of 1 cells under 2 columns");
  }
}

}  // namespace
}  // namespace sprung::report
