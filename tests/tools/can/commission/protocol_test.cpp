#include "tools/can/commission/protocol.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sprung::commission {
namespace {

Protocol sample() {
  Protocol protocol;
  protocol.drive = "knee_motor: node 2 on <leg>";
  protocol.steps.push_back({"node id", {{"who answers", "one", "one"}}});
  protocol.steps.push_back(
      {"encoder",
       {{"counts", "4096", "500", Verdict::kDiffers, "set it"}, {"type", "1", "1", Verdict::kOk}}});
  protocol.written = {"0x6007: set for this walk, put back"};
  return protocol;
}

TEST(Protocol, AStepIsAsBadAsItsWorstFinding) {
  const Protocol protocol = sample();
  EXPECT_EQ(protocol.steps[0].verdict(), Verdict::kOk);
  EXPECT_EQ(protocol.steps[1].verdict(), Verdict::kDiffers);
  EXPECT_EQ(Step{"empty"}.verdict(), Verdict::kSkipped);
  EXPECT_EQ(protocol.first_difference(), "encoder");
}

TEST(Protocol, OnlyAFinishedWalkWithoutDifferencesIsOk) {
  Protocol protocol = sample();
  EXPECT_FALSE(protocol.ok());
  protocol.steps.pop_back();
  EXPECT_FALSE(protocol.ok()) << "not finished";
  protocol.finished = true;
  EXPECT_TRUE(protocol.ok());
  protocol.steps.push_back({"brake", {{"brake", "none", "", Verdict::kNeedsHand}}});
  EXPECT_FALSE(protocol.ok());
}

TEST(Protocol, TheTextSaysWhatToDo) {
  const std::string text = step_text(sample().steps[1]);
  EXPECT_NE(text.find("DIFFERS"), std::string::npos);
  EXPECT_NE(text.find("counts: 500; expected 4096"), std::string::npos);
  EXPECT_NE(text.find("-> set it"), std::string::npos);
  EXPECT_NE(summary_text(sample()).find("Stopped by: encoder"), std::string::npos);
  EXPECT_NE(summary_text(sample()).find("never powered"), std::string::npos);
}

TEST(Protocol, ThePageHasEveryFindingAndWhatWasWritten) {
  report::Report page{"Commissioning"};
  page.sections.push_back(protocol_section(sample()));
  const std::string html = report::to_html(page);
  for (const char* part : {"4096", "set it", "put back", "&lt;leg&gt;", "never powered"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(Protocol, TheJsonCanBeReadByAScript) {
  const auto json = nlohmann::json::parse(protocol_json({sample()}));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["stopped_by"], "encoder");
  EXPECT_EQ(json[0]["findings"].size(), 3U);
  EXPECT_EQ(json[0]["findings"][1]["verdict"], "DIFFERS");
}

}  // namespace
}  // namespace sprung::commission
