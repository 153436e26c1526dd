#include "tools/lab/campaign/draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

std::string words(const Draw& draw, const RobotConfig& robot) {
  std::string out = draw.state + " " + std::to_string(draw.wait_s) + " " + std::to_string(draw.sim.seed);
  for (const Injection& injection : draw.injections)
    out += " | " + text_of(injection, robot) + " at " + std::to_string(injection.at_seq);
  return out;
}

TEST(CampaignDraw, SameSeedAndNumberGiveTheSameAndOthersDoNot) {
  const RobotConfig robot = load_robot("pegasus");
  std::set<std::string> seen;
  for (std::uint64_t number = 0; number < 200; ++number) {
    const std::string now = words(draw_run(robot, 5, number, Class::kNone), robot);
    EXPECT_EQ(now, words(draw_run(robot, 5, number, Class::kNone), robot));
    EXPECT_TRUE(seen.insert(now).second) << now;
    EXPECT_TRUE(seen.insert(words(draw_run(robot, 6, number, Class::kNone), robot)).second);
  }
}

TEST(CampaignDraw, EveryStateEveryClassAndEveryFaultComesUp) {
  const RobotConfig robot = load_robot("pegasus");
  std::set<std::string> states, kinds, drive_faults;
  int pairs = 0, while_clearing = 0;
  for (std::uint64_t number = 0; number < 2000; ++number) {
    const Draw draw = draw_run(robot, 1, number, Class::kNone);
    states.insert(draw.state);
    pairs += draw.injections.size() == 2 ? 1 : 0;
    while_clearing += draw.second_while_clearing ? 1 : 0;
    for (const Injection& one : draw.injections) {
      kinds.insert(name(one.kind));
      if (one.kind == Class::kDrive || one.kind == Class::kBus) drive_faults.insert(name(one.drive_fault));
    }
  }
  const std::vector<std::string> all = states_of(robot);
  EXPECT_EQ(states, std::set<std::string>(all.begin(), all.end()));
  EXPECT_THAT(all, testing::IsSupersetOf({"rising", "standing", "comply", "crawl", "walk", "trot", "sitting",
                                          "clearing", "homing"}));
  EXPECT_EQ(kinds.size(), std::size(kWords<Class>) - 1) << "all but `none`";
  EXPECT_EQ(drive_faults.size(), 19u);
  EXPECT_GT(pairs, 400);
  EXPECT_GT(while_clearing, 150);
}

TEST(CampaignDraw, OnlyOneClassWhereOneIsAsked) {
  const RobotConfig robot = load_robot("single_leg");
  for (std::uint64_t number = 0; number < 100; ++number)
    for (const Injection& one : draw_run(robot, 1, number, Class::kForeign).injections)
      EXPECT_EQ(one.kind, Class::kForeign);
}

TEST(CampaignDraw, LegThatJumpsIsDrawnInEachPhaseOfAJump) {
  EXPECT_THAT(states_of(load_robot("single_leg")),
              testing::IsSupersetOf({"crouch", "thrust", "flight", "landing", "rising", "sitting"}));
}

}  // namespace
}  // namespace sprung::campaign
