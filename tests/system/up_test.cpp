/// What `sprung up` does with its processes: which come back, which do not, which are refused.
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "lcmtypes/channels.h"
#include "runtime/own_port.h"
#include "tests/support/paths.h"
#include "tests/system/up_fixture.h"
#include "tools/operate/launcher/run_description.h"
#include "tools/operate/launcher/status_board.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST_F(Up, ClosedTerminalStopsItInOrder) {
  std::signal(SIGHUP, SIG_DFL);  // inherited: the tests may run under nohup
  up("lockstep", "--speed 1");
  up_process().signal(SIGHUP);
  EXPECT_EQ(wait_for_up(), 0);
  EXPECT_THAT(said(), HasSubstr("stopping, drives first"));
}

TEST_F(Up, SecondRobotOnTheSameBusIsRefusedAndTheFirstNotDisturbed) {
  up("lockstep", "--speed 1");
  const CommandResult second = sprung("up single_leg --sim --no-record --instance second --lcm-url '" +
                                      lcm_url_on_port(own_port()) + "' --can leg=" + can_address());
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.output, AllOf(HasSubstr("'default'"), HasSubstr(can_address()), HasSubstr("--can")));
  EXPECT_EQ(sprung("stand").status, 0);
}

/// Whoever loses its parent becomes this process's child, as long as this lives: in its session, where a
/// stopped process stays stopped. Below a parent of another session the kernel wakes it with SIGHUP and
/// SIGCONT (POSIX: an orphaned process group), and it ends in order.
class Adoption {
 public:
  Adoption() { prctl(PR_SET_CHILD_SUBREAPER, 1); }
  ~Adoption() { prctl(PR_SET_CHILD_SUBREAPER, 0); }
  Adoption(const Adoption&) = delete;
  Adoption& operator=(const Adoption&) = delete;
};

bool is_stopped(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string id, program, state;
  return stat >> id >> program >> state && state == "T";
}

/// The service has a run folder of its own, a user's shell another.
TEST_F(Up, RealTimeSecondRobotOnTheSameBusIsRefusedWhereverItsRunFolderIsAndTheFirstStands) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::create_directory(other);
  setenv("SPRUNG_RUN_DIR", other.c_str(), 1);
  const CommandResult second = sprung("up single_leg --sim --no-record --timeout 5 --lcm-url '" +
                                      lcm_url_on_port(own_port()) + "' --can leg=" + can_address());
  setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.output, HasSubstr("in use by another process on this machine"));
  EXPECT_THAT(sprung("status").output, HasSubstr("operational, cause none"));
}

/// Else two bridges would be on one bus.
TEST_F(Up, NothingStartsBesideABridgeWhoseLauncherWasKilled) {
  const Adoption adoption;
  up("lockstep", "--speed 1");
  const auto bridge = static_cast<pid_t>(pid_of("sprung-can-bridge"));
  kill(bridge, SIGSTOP);
  ASSERT_TRUE(within(kTimeout_s, [&] { return is_stopped(bridge); }));
  up_process().signal(SIGKILL);
  EXPECT_EQ(wait_for_up(), 128 + SIGKILL);
  const std::string again = "up single_leg --sim --no-record --cycles 10 --clock lockstep --lcm-url '" +
                            lcm_url() + "' --can leg=" + can_address();
  const std::string number = std::to_string(bridge);
  for (int tries = 0; tries < 2; ++tries) {  // who is refused tries again
    const CommandResult refused = sprung(again + " --timeout 0.5");
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.output, AllOf(HasSubstr("sprung-can-bridge (process " + number), HasSubstr("kill -9"),
                                      ContainsRegex("kill -9[0-9 ]* " + number)));
  }
  kill(bridge, SIGKILL);
  EXPECT_TRUE(all_end(kTimeout_s));
  const CommandResult next = sprung(again);
  EXPECT_EQ(next.status, 0) << next.output;
}

TEST_F(Up, LockStepThatIsNoLongerDeterministicSaysSoLiveAndInItsLog) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  ASSERT_THAT(sprung("status").output, Not(HasSubstr("not deterministic")));
  // the leg controller waits for half of that
  EXPECT_TRUE(
      stalled("sprung-motion-planner", 600, "was made from older messages: this run is not deterministic"))
      << sprung("status").output;
  EXPECT_TRUE(says("this run is not deterministic"));
  send_no_message(channels::kDriveCommand);
  std::string status;
  EXPECT_TRUE(within(kTimeout_s, [&] {
    status = sprung("status").output;
    return status.find("DRIVE_COMMAND refused: ") != std::string::npos;
  }));
  EXPECT_THAT(status, ContainsRegex("DRIVE_COMMAND refused: [^\n]*this run is not deterministic"));
  const std::string log = info().log;
  ASSERT_EQ(sprung("down").status, 0);
  EXPECT_THAT(info_of_log(log), HasSubstr("lock-step  not deterministic: "));
  EXPECT_THAT(sprung("replay " + log + " --into estimator,planner,controller").output,
              HasSubstr("not deterministic: "));
}

TEST_F(Up, LockStepWhoseDrivesAreSilentIsNoLongerDeterministicAndSaysSoLiveAndInItsLog) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  // the bridge waits for a second
  EXPECT_TRUE(stalled("sprung-sim-drives", 1300, "the drives do not answer on")) << sprung("status").output;
  EXPECT_THAT(sprung("status").output, HasSubstr("this run is not deterministic"));
  EXPECT_TRUE(says("this run is not deterministic"));
  const std::string log = info().log;
  ASSERT_EQ(sprung("down").status, 0);
  EXPECT_THAT(info_of_log(log),
              HasSubstr("lock-step  not deterministic: the bridge went on without an answer"));
  const std::string went_on = "not deterministic: the bridge went on without an answer in ";
  EXPECT_THAT(sprung("log verify " + log).output, AllOf(HasSubstr("note   " + went_on), HasSubstr(": good")));
  const CommandResult replay = sprung("replay " + log + " --into estimator,planner,controller");
  EXPECT_THAT(replay.output, AllOf(HasSubstr(went_on), HasSubstr("of a run that was not deterministic")));
}

/// They wait for a second, and no cycle of the log shows that they went on.
TEST_F(Up, LockStepWhoseBridgeHoldsStillIsNoLongerDeterministicAndTheDrivesSaySoLiveAndInItsLog) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  EXPECT_TRUE(stalled("sprung-can-bridge", 1500, "no SYNC for a second")) << sprung("status").output;
  EXPECT_THAT(sprung("status").output, HasSubstr("this run is not deterministic"));
  EXPECT_TRUE(says("this run is not deterministic"));
  const std::string log = info().log;
  ASSERT_EQ(sprung("down").status, 0);
  const std::string said = "not deterministic: sprung-sim-drives: no SYNC for a second";
  EXPECT_THAT(info_of_log(log), HasSubstr("lock-step  " + said));
  EXPECT_THAT(sprung("log verify " + log).output, AllOf(HasSubstr("note   " + said), HasSubstr(": good")));
  EXPECT_THAT(sprung("replay " + log + " --into estimator,planner,controller").output,
              AllOf(HasSubstr("note: " + said), HasSubstr("of a run that was not deterministic")));
}

/// So that the tests above show something.
TEST_F(Up, LockStepThatWasNotDisturbedIsCalledNotDeterministicNowhere) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  ASSERT_EQ(sprung("stand").status, 0);
  const std::string log = info().log;
  ASSERT_EQ(sprung("down").status, 0);
  for (const std::string command :
       {"log info ", "log verify ", "replay --into estimator,planner,controller "})
    EXPECT_THAT(sprung(command + log).output, Not(HasSubstr("not deterministic"))) << command;
  EXPECT_EQ(sprung("replay " + log + " --into estimator,planner,controller").status, 0);
  EXPECT_THAT(said(), Not(HasSubstr("not deterministic")));
}

TEST_F(Up, WhereNoDriveAnswersSimulatedOnesAreNamed) {
  const CommandResult result = sprung("up single_leg --no-record --timeout 5 --lcm-url '" + lcm_url() +
                                      "' --can leg=" + can_address());
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, AllOf(HasSubstr("sprung-can-bridge is not running after 5 s"),
                                   HasSubstr("With simulated drives: sprung up single_leg --sim")));
}

TEST_F(Up, LauncherThatWasStoppedForAWhileDoesNotTakeTheOthersForSilent) {
  up("lockstep", "--speed 1");
  up_process().signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::microseconds(StatusBoard::kSilent_us + 500'000));
  up_process().signal(SIGCONT);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0) << said();
  EXPECT_EQ(said().find("has said nothing"), std::string::npos) << said();
}

/// The bridge brings its drives to rest in half a second of the robot's time, which is some ten of ours here.
/// A busy machine is as slow.
TEST_F(Up, SlowLockStepIsStoppedInOrderToo) {
  up("lockstep", "--speed 0.05 --timeout 60");
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0) << said();
}

TEST_F(Up, BridgeThatHangsInLockStepIsKilledAndNamed) {
  up("lockstep", "--speed 1");
  signal_program("sprung-can-bridge", SIGSTOP);
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1);
  EXPECT_THAT(said(), HasSubstr("sprung-can-bridge did not end when asked and was killed"));
}

TEST_F(Up, WhatDoesNotEndWhenAskedIsKilledAndNamed) {
  up("lockstep", "--speed 1");
  signal_program("sprung-motion-planner", SIGSTOP);
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1);
  EXPECT_THAT(said(), HasSubstr("sprung-motion-planner did not end when asked and was killed"));
}

TEST_F(Up, ContradictionsAreWrongUseBeforeAnybodyIsWaitedFor) {
  for (const char* wrong : {"--sim --host tail", "--clock lockstep", "--sim --preset worst",
                            "--sim --can arm=socketcan:can0", "--sim --with lcm-logger --split-mb 5"}) {
    const CommandResult result = sprung("up single_leg " + std::string(wrong));
    EXPECT_EQ(result.status, 2) << wrong << result.output;
    EXPECT_EQ(result.output.find("is heard"), std::string::npos) << result.output;
  }
}

TEST_F(Up, DownOfAnotherUsersRobotSaysSo) {
  if (getuid() != 0 || std::system(("setpriv --reuid=65534 --clear-groups " + test::bin_dir() +
                                    "/sprung --version > /dev/null 2>&1")
                                       .c_str()) != 0)
    GTEST_SKIP() << "needs root, and programs that others may run";
  chmod(folder_.c_str(), 0755);  // others may look at the run folder, as they may in /tmp
  up("lockstep", "--speed 1");
  const int raw = std::system(("setpriv --reuid=65534 --clear-groups " + test::bin_dir() + "/sprung down > " +
                               (folder_ / "down.txt").string() + " 2>&1")
                                  .c_str());
  EXPECT_EQ(WEXITSTATUS(raw), 1);
  EXPECT_THAT(read_all(folder_ / "down.txt"), HasSubstr("another user"));
  EXPECT_FALSE(up_process().ended());
}

TEST_F(Up, RealTimeControllerComesBackWithoutTorqueAndStandsAgainOnlyWhenAsked) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  const std::int64_t old_pid = pid_of("sprung-leg-controller");
  kill_program("sprung-leg-controller");
  ASSERT_TRUE(comes_back("sprung-leg-controller", old_pid)) << said();
  EXPECT_TRUE(within(kTimeout_s, [&] { return said().find("torque stays off") != std::string::npos; }))
      << said();
  EXPECT_THAT(said(), HasSubstr("sprung-leg-controller was started again (1 of at most 3 times)"));
  EXPECT_NE(sprung("stand").status, 0) << "the cause is latched";
  EXPECT_EQ(sprung("clear").status, 0);
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
}

TEST_F(Up, RealTimeProcessThatStayedDeadUntilTheEndIsAFailure) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  kill_program("sprung-motion-planner");  // the robot is damped, with power: it waits for an estop
  EXPECT_TRUE(says("it is started again once no drive has torque")) << said();
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1);
}

TEST_F(Up, NothingComesBackInLockStep) {
  up("lockstep", "--speed 1");
  kill_program("sprung-motion-planner");
  EXPECT_TRUE(within(kTimeout_s, [&] { return said().find("It is not started again") != std::string::npos; }))
      << said();
  EXPECT_THAT(said(), HasSubstr("sprung-motion-planner ended (Killed)"));
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1) << "a process died: the run has failed";
}

std::string planner_of_paper() {
  return "exec " + test::bin_dir() + "/sprung-motion-planner \"${@/#best/paper}\"";
}

TEST_F(Up, ProcessWithAnotherConfigurationIsRefusedAndNamed) {
  replace_program("sprung-motion-planner", planner_of_paper());
  EXPECT_THAT([&] { up("lockstep"); }, testing::ThrowsMessage<std::runtime_error>(
                                           AllOf(HasSubstr("sprung-motion-planner on "),
                                                 HasSubstr("another configuration"), HasSubstr("--preset"))));
}

TEST_F(Up, RealTimeProcessThatIsStartedAgainAndDoesNotBelongHereIsEndedAndNamed) {
  replace_program("sprung-motion-planner", "exec " + test::bin_dir() + "/sprung-motion-planner \"$@\"");
  up("realtime");
  replace_program("sprung-motion-planner", planner_of_paper());
  kill_program("sprung-motion-planner");
  EXPECT_TRUE(says("another configuration")) << said();
  EXPECT_TRUE(says("sprung-motion-planner ended (exit status 0). It is not started again")) << said();
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1);
}

TEST_F(Up, ProgramThatEndsWhileStartingIsNamedWithItsLastWords) {
  replace_program("sprung-torque-estimator", "echo no torque today; exit 3");
  EXPECT_THAT([&] { up("lockstep"); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("sprung-torque-estimator ended while starting: exit status 3"),
                        HasSubstr("sprung-torque-estimator: no torque today"))));
}

TEST_F(Up, SystemdHearsReadyAliveAndStopping) {
  const std::string path = (folder_ / "notify").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  setenv("WATCHDOG_USEC", "200000", 1);
  up("lockstep", "--speed 1");
  std::string heard;
  const auto listen = [&](const char* what) {
    return within(kTimeout_s, [&] {
      std::array<char, 256> text{};
      while (recv(fd, text.data(), text.size() - 1, 0) > 0) {
        heard += std::string(text.data()) + ";";
        text.fill('\0');
      }
      return heard.find(what) != std::string::npos;
    });
  };
  EXPECT_TRUE(listen("READY=1")) << heard;
  EXPECT_TRUE(listen("WATCHDOG=1")) << heard;
  kill_program("sprung-motion-planner");
  EXPECT_TRUE(listen("STATUS=sprung-motion-planner ended (Killed)")) << heard;
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_TRUE(listen("STOPPING=1")) << heard;
  close(fd);
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) unsetenv(name);
}

}  // namespace
}  // namespace sprung
