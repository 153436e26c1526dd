#include "tools/station/play/log_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sprung_msgs/sim_truth_t.hpp"
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
  /// A hundred cycles with SIM_TRUTH; of every nth the JOINT_STATE is of a type that nobody knows.
  static std::vector<Kept> with_truth_and_other_joints(int nth) {
    auto about = log::stamped<sprung_msgs::log_metadata_t>(-1);
    about.robot_yaml = log::robot_yaml("single_leg");
    about.version = "0.9";
    about.git_hash = "abc";
    std::vector<Kept> events{log::metadata_event()};
    events.front().data = log::encoded(about);
    for (int cycle = 0; cycle < 100; ++cycle) {
      auto truth = log::stamped<sprung_msgs::sim_truth_t>(cycle);
      truth.n_joints = 2;
      truth.joints.resize(2);
      truth.n_legs = 1;
      truth.legs.resize(1);
      events.push_back(log::kept(channels::kSimTruth, cycle, log::encoded(truth)));
      events.push_back(log::joint_event(cycle));
      if (cycle % nth == 0) events.back().data[0] ^= 0x55;
    }
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

TEST_F(LogPageTest, SaysThatTheRobotsLengthsAreOthersNow) {
  const LogPage page = page_of(events_of(log::robot_yaml("single_leg", "0.260 m", "0.261 m")));
  EXPECT_FALSE(config_of(page)["scene"].is_null());
  EXPECT_THAT(page.notes, Contains(HasSubstr("whose robot.yaml has other lengths")));
  const LogPage same = page_of(events_of(log::robot_yaml("single_leg")));
  EXPECT_THAT(same.notes, Not(Contains(HasSubstr("other lengths"))));
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

TEST_F(LogPageTest, WhoseJointStatesAreOfAnotherVersionDrawsNoPoseAndSaysWhy) {
  const LogPage page = page_of(with_truth_and_other_joints(1));
  const nlohmann::json config = config_of(page);
  EXPECT_TRUE(config["scene"].is_null());
  EXPECT_THAT(config["scene_missing"], HasSubstr("JOINT_STATE is of another version of its message"));
  EXPECT_THAT(page.notes, Contains(HasSubstr("JOINT_STATE is of another version of its message: its values "
                                             "are missing; use the sprung that made the log: 0.9 (abc)")));
  EXPECT_THAT(page.notes, Not(Contains(HasSubstr("Nothing measures the trunk"))));
  EXPECT_EQ(config["data"]["cycles"], 100) << "times and plots are there all the same";
}

TEST_F(LogPageTest, OfWhichSomeMessagesAreOfAnotherVersionSaysHowMany) {
  const LogPage page = page_of(with_truth_and_other_joints(2));
  EXPECT_FALSE(config_of(page)["scene"].is_null());
  EXPECT_THAT(page.notes, Contains(HasSubstr("50 of 100 messages of JOINT_STATE are damaged or of another")));
}

TEST_F(LogPageTest, WithoutJointStatesDrawsNoPose) {
  std::vector<Kept> events = with_truth_and_other_joints(1);
  events.erase(std::remove_if(events.begin(), events.end(),
                              [](const Kept& kept) { return kept.channel == channels::kJointState; }),
               events.end());
  const nlohmann::json config = config_of(page_of(events));
  EXPECT_TRUE(config["scene"].is_null());
  EXPECT_THAT(config["scene_missing"], HasSubstr("there is no JOINT_STATE"));
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
