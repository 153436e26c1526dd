#include "tools/lab/commands/play_pages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;

class PlayPagesTest : public testing::Test {
 protected:
  void SetUp() override { InProcessRobot::observe_all_by(observer_for_page); }
  void TearDown() override { InProcessRobot::observe_all_by({}); }

  static void run_a_leg(double seconds) {
    const RobotConfig robot = load_robot("single_leg");
    InProcessRobot leg(robot, "best", SimOptions{});
    leg.boot();
    for (double t = 0.0; t < seconds; t += robot.cycle_s) leg.tick();
  }

  test::OwnFolder folder_{"play-pages"};
};

TEST_F(PlayPagesTest, PageIsOfTheFirstRobotAndItsLogIsGone) {
  const std::string name = play_pages_into(folder_.path().string())("fell", [] {
    run_a_leg(0.1);
    run_a_leg(0.3);
  });
  EXPECT_EQ(name, "fell.html");
  std::ifstream file(folder_ / name);
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find("single_leg-000.lcm"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(PlayPagesTest, WithoutARobotThereIsNone) {
  EXPECT_EQ(play_pages_into(folder_.path().string())("nobody", [] {}), "");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(PlayPagesTest, WhatFailsLeavesNothing) {
  const PlayPage pages = play_pages_into(folder_.path().string());
  EXPECT_THROW(pages("fails", [] { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  EXPECT_EQ(observer_for_page(load_robot("single_leg"), "best", SimOptions{}), nullptr);
}

}  // namespace
}  // namespace sprung::commands
