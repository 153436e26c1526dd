/// The operator's command line against real processes, as a person types it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/changed_robot.h"
#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class Operator : public SystemTest {};

TEST_F(Operator, WithNothingRunningEveryCommandSaysHowToStart) {
  for (const char* command : {"stand", "jump", "sit", "stop", "estop", "clear", "status", "down", "record"}) {
    const CommandResult result = sprung(command);
    EXPECT_EQ(result.status, 1) << command;
    EXPECT_THAT(result.output, HasSubstr("sprung up single_leg --sim")) << command;
  }
}

TEST_F(Operator, WrongUseIsStatusTwo) {
  EXPECT_EQ(sprung("jump --hight 3").status, 2);
  EXPECT_EQ(sprung("jmup").status, 2);
  EXPECT_EQ(sprung("jump --mode wild").status, 2);
  EXPECT_EQ(sprung("").status, 2);
}

TEST_F(Operator, HelpHasAnExample) {
  for (const char* command :
       {"up", "down", "stand", "jump", "stop", "estop", "clear", "status", "record", "experiment jump"}) {
    const CommandResult result = sprung(std::string(command) + " --help");
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("xample")) << command;
  }
}

TEST_F(Operator, UnknownRobotAndPresetAreNamed) {
  EXPECT_THAT(sprung("up nobody --sim").output, HasSubstr("single_leg"));
  EXPECT_THAT(sprung("up single_leg --sim --preset worst").output, HasSubstr("paper, best"));
  EXPECT_THAT(sprung("up single_leg --clock lockstep").output, HasSubstr("needs --sim"));
  EXPECT_THAT(sprung("experiment jump --plant no_such_value=1").output, HasSubstr("friction_scale"));
}

TEST_F(Operator, NobodyMayTypeANumberThatIsNotFinite) {
  for (const char* command :
       {"walk --speed nan", "walk --turn=-inf", "jump --height inf", "land --in nan",
        "comply --stiffness nan 2", "comply --damping 1 1e999", "fault knee encoder-jump --value nan",
        "up single_leg --sim --speed nan", "replay no.lcm --speed inf"}) {
    const CommandResult result = sprung(command);
    EXPECT_EQ(result.status, 2) << command << result.output;
    EXPECT_THAT(result.output, HasSubstr("must be a finite number")) << command;
  }
  EXPECT_THAT(sprung("experiment jump --plant friction_scale=nan").output, HasSubstr("the number is finite"));
  EXPECT_EQ(sprung("experiment jump --set presets.best.stand_length=nan").status, 2);
  EXPECT_NE(sprung("log info no.lcm --from nan").status, 0);
}

/// The shipped leg with one preset, which is called soft, as somebody's own folder.
void write_soft_leg(const std::filesystem::path& folder) {
  std::filesystem::copy(test::source_dir() + "/robots/single_leg", folder,
                        std::filesystem::copy_options::recursive);
  std::string yaml = test::shipped_yaml("single_leg");
  const std::size_t paper = yaml.find("\n  paper:");
  const std::size_t best = yaml.find("\n  best:");
  yaml = yaml.substr(0, paper) + "\n  soft:" + yaml.substr(best + std::string("\n  best:").size());
  std::ofstream(folder / "robot.yaml") << yaml;
}

TEST_F(Operator, ARobotOfOnesOwnFolderIsOperatedFromAnyWorkingFolder) {
  std::filesystem::create_directories(folder_ / "elsewhere");
  write_soft_leg(folder_ / "mine");
  typed_robot_ = "./mine";
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  up("lockstep", "--speed 4");
  std::filesystem::current_path(folder_ / "elsewhere");
  const auto status = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(status["preset"], "soft") << "the only one there is";
  EXPECT_EQ(status["motion"]["state"], "idle");
  for (const char* command : {"clear", "move knee --by 2deg", "sit"}) {
    const CommandResult result = sprung(command);
    EXPECT_EQ(result.status, 0) << command << ": " << result.output;
  }
  std::filesystem::current_path(before);
}

TEST_F(Operator, SeveralPresetsAndNoneCalledBestAreNamed) {
  const std::filesystem::path folder = folder_ / "mine";
  write_soft_leg(folder);
  std::ofstream(folder / "robot.yaml")
      << test::replaced(test::shipped_yaml("single_leg"), "\n  best:", "\n  soft:");
  for (const std::string& command :
       {"up " + folder.string() + " --sim --no-record", "experiment jump --robot " + folder.string()}) {
    const CommandResult result = sprung(command);
    EXPECT_NE(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("choose with --preset, one of: paper, soft")) << command;
  }
}

TEST_F(Operator, MotionOfAPlannerThatIsHaltedIsNotToldAsIfItWereNow) {
  up("lockstep", "--speed 2");
  const auto processes = info().processes;
  const auto planner = std::find_if(processes.begin(), processes.end(), [](const RunningProcess& process) {
    return process.program == "sprung-motion-planner";
  });
  ASSERT_NE(planner, processes.end());
  kill(static_cast<pid_t>(planner->pid), SIGSTOP);
  const CommandResult told = sprung("status");
  kill(static_cast<pid_t>(planner->pid), SIGCONT);
  EXPECT_THAT(told.output, HasSubstr("motion  unknown: nothing heard of the motion planner"));
  EXPECT_THAT(told.output, HasSubstr("TROUBLE sprung-motion-planner is stopped"));
}

TEST_F(Operator, EachJumpIsToldItsHeightWithoutAReport) {
  up("lockstep", "--speed 4");
  ASSERT_EQ(sprung("stand").status, 0);
  const CommandResult jump = sprung("jump --count 2");
  EXPECT_EQ(jump.status, 0) << jump.output;
  EXPECT_THAT(jump.output, testing::ContainsRegex("jump 1: 1[789][0-9] mm high, estimated from flight time"));
  EXPECT_THAT(jump.output, testing::ContainsRegex("jump 2: 1[789][0-9] mm high, estimated from flight time"));
  EXPECT_THAT(sprung("jump --height 150").output, HasSubstr("mm high (asked 150 mm)"));
}

TEST_F(Operator, FaultNoneSaysThatFaultsAreTakenAway) {
  up("lockstep", "--speed 2");
  const CommandResult none = sprung("fault knee none");
  EXPECT_EQ(none.status, 0) << none.output;
  EXPECT_THAT(none.output, HasSubstr("knee: faults that were made there are taken away at cycle"));
  EXPECT_THAT(none.output, testing::Not(HasSubstr("acts")));
}

TEST_F(Operator, StandJumpAndDown) {
  up("lockstep");
  EXPECT_THAT(sprung("jump").output, HasSubstr("refused"));
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
  const CommandResult jump = sprung("jump --count 2 --report");
  EXPECT_EQ(jump.status, 0) << jump.output;
  EXPECT_THAT(jump.output, HasSubstr("   2 "));
  EXPECT_THAT(jump.output, HasSubstr("yes"));
  EXPECT_EQ(sprung("jump --height 1000").status, 1);
  const CommandResult down = sprung("down");
  EXPECT_EQ(down.status, 0) << down.output;
  EXPECT_EQ(wait_for_up(), 0);
}

TEST_F(Operator, WrongRobotAndSecondUpAreRefused) {
  up("lockstep", "--speed 2");
  EXPECT_THAT(sprung("stand --robot pegasus").output, HasSubstr("single_leg is up, not pegasus"));
  const CommandResult second = sprung("up single_leg --sim");
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.output, HasSubstr("is up already"));
}

TEST_F(Operator, StatusIsJsonWithTheAgreedKeys) {
  up("lockstep", "--speed 2");
  const auto json = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(json["robot"], "single_leg");
  EXPECT_EQ(json["clock"], "lockstep");
  EXPECT_EQ(json["safety"]["state"], "operational");
  EXPECT_EQ(json["motion"]["state"], "idle");
  EXPECT_EQ(json["motion"]["legs"].size(), 1u);
  ASSERT_EQ(json["processes"].size(), 5u);
  for (const auto& process : json["processes"]) {
    EXPECT_EQ(process["state"], "running") << process["name"];
    EXPECT_TRUE(process["rate_hz"].is_number()) << process["name"];
    EXPECT_GT(process["pid"], 0);
  }
}

TEST_F(Operator, EmergencyStopLatchesUntilClearAndTorqueStaysOff) {
  up("lockstep", "--speed 4");
  ASSERT_EQ(sprung("stand").status, 0);
  ASSERT_EQ(sprung("estop").status, 0);
  auto json = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(json["safety"]["state"], "disabled");
  EXPECT_EQ(json["safety"]["cause"], "emergency stop");
  EXPECT_EQ(json["motion"]["state"], "idle");
  EXPECT_THAT(sprung("stand").output, HasSubstr("refused"));
  const CommandResult clear = sprung("clear");
  EXPECT_EQ(clear.status, 0) << clear.output;
  json = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(json["safety"]["state"], "operational");
  EXPECT_EQ(json["motion"]["state"], "idle");
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
}

TEST_F(Operator, RecordWritesAnLcmLogOfEveryChannel) {
  up("lockstep", "--speed 2");
  const std::string file = (folder_ / "record.lcm").string();
  const std::string command = "exec " + test::bin_dir() + "/sprung record " + file + " > /dev/null";
  ChildProcess record("/bin/sh", {"-c", command});
  EXPECT_TRUE(grows(file, 500'000));
  usleep(1'000'000);  // every process says twice a second that it lives
  record.signal(SIGINT);
  while (!record.ended()) usleep(10'000);
  EXPECT_EQ(*record.ended(), 0);
  lcm::LogFile log(file, "r");
  ASSERT_TRUE(log.good());
  std::set<std::string> channels;
  while (const lcm::LogEvent* event = log.readNextEvent()) channels.insert(event->channel);
  EXPECT_THAT(channels, testing::IsSupersetOf({"DRIVE_STATE", "JOINT_STATE", "LEG_COMMAND", "DRIVE_COMMAND",
                                               "MOTION_STATE", "SAFETY_STATE", "CAN_TRACE", "SIM_TRUTH",
                                               "PROCESS_STATUS"}));
}

TEST_F(Operator, CtrlCEndsEveryProcess) {
  up("lockstep", "--speed 2");
  up_process().signal(SIGINT);
  EXPECT_EQ(wait_for_up(), 0);  // TearDown checks that nothing is left
}

TEST_F(Operator, DeathOfTheLauncherEndsEveryProcess) {
  up("lockstep", "--speed 2");
  up_process().signal(SIGKILL);
  wait_for_up();
  EXPECT_TRUE(all_end(kTimeout_s));  // a bridge brings its drives to rest first
}

}  // namespace
}  // namespace sprung
