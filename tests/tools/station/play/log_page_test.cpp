#include "tools/station/play/log_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/refusal.h"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::station {
namespace {

using log::Kept;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class LogPageTest : public testing::Test {
 protected:
  LogPage page_of(const std::vector<Kept>& events) {
    log::write_all(path_, events);
    log::Reader reader(path_);
    return make_log_page(reader);
  }
  std::string refusal_of(const std::vector<Kept>& events) {
    return test::refusal_of<std::runtime_error>([&] { page_of(events); });
  }
  static std::vector<Kept> events_of(const std::string& yaml, std::int64_t cycles = 200) {
    std::vector<Kept> events = log::robot_events(cycles);
    events.front() = log::metadata_event(yaml);
    return events;
  }
  static nlohmann::json config_of(const LogPage& page) {
    const std::string begin = "id=\"config\">";
    const std::size_t from = page.html.find(begin) + begin.size();
    return nlohmann::json::parse(page.html.substr(from, page.html.find("</script>", from) - from));
  }
  log::LogFolder folder_;
  std::string path_ = folder_("jump.lcm");
};

TEST_F(LogPageTest, HasRobotLayoutEventsAndPhases) {
  const LogPage page = page_of(events_of(log::robot_yaml("single_leg")));
  const nlohmann::json config = config_of(page);
  EXPECT_EQ(config["mode"], "log");
  EXPECT_EQ(config["title"], "single_leg, jump.lcm");
  EXPECT_EQ(config["scene"]["robot"], "single_leg");
  EXPECT_EQ(config["data"]["cycles"], 200);
  ASSERT_FALSE(config["events"].empty());
  bool walked = false;
  for (const auto& event : config["events"])
    walked = walked || event["text"].get<std::string>().find("motion walking") == 0;
  EXPECT_TRUE(walked) << config["events"];
  EXPECT_THAT(page.notes, Contains(HasSubstr("Nothing measures the trunk")));
}

TEST_F(LogPageTest, SaysThatTheRobotsFileIsAnotherNow) {
  const LogPage page = page_of(events_of(log::robot_yaml("single_leg", "0.260 m", "0.261 m")));
  EXPECT_FALSE(config_of(page)["scene"].is_null());
  EXPECT_THAT(page.notes, Contains(HasSubstr("whose robot.yaml is another than this log's")));
  const LogPage same = page_of(events_of(log::robot_yaml("single_leg")));
  EXPECT_THAT(same.notes, Not(Contains(HasSubstr("another"))));
}

TEST_F(LogPageTest, OfARobotThatIsNotHereHasPlotsAndSaysWhy) {
  const LogPage page = page_of(
      events_of(log::robot_yaml("single_leg", "robot: single_leg", "robot: stranger")));
  EXPECT_TRUE(config_of(page)["scene"].is_null());
  EXPECT_THAT(page.notes, Contains(HasSubstr("No model of this robot is here")));
}

TEST_F(LogPageTest, SaysThatTheLogWasCutOff) {
  std::vector<Kept> events = events_of(log::robot_yaml("single_leg"));
  events.pop_back();
  EXPECT_THAT(page_of(events).notes, Contains(HasSubstr("no end")));
}

TEST_F(LogPageTest, OfALogWithoutARobotIsRefusedWithWhatReadsIt) {
  EXPECT_THAT(refusal_of({log::joint_event(0), log::joint_event(1)}),
              testing::AllOf(HasSubstr("jump.lcm cannot be played"), HasSubstr("sprung log info")));
}

TEST_F(LogPageTest, OfALogWithoutACycleIsRefused) {
  EXPECT_THAT(refusal_of({log::metadata_event(log::robot_yaml("single_leg")), log::end_event(0, 1)}),
              HasSubstr("has no cycle of the robot to show"));
}

TEST_F(LogPageTest, OfMessagesOfAnotherVersionIsRefusedByName) {
  std::vector<Kept> events{log::metadata_event(log::robot_yaml("single_leg"))};
  for (int k = 0; k < 5; ++k) {
    events.push_back(log::joint_event(k));
    events.back().data[0] ^= 0x55;  // the fingerprint of a type that nobody knows
  }
  EXPECT_THAT(refusal_of(events), HasSubstr("of a version that this sprung does not know"));
}

}  // namespace
}  // namespace sprung::station
