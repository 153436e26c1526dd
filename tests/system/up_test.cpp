/// What `sprung up` does with its processes: which come back, which do not, which are refused, on one host and on two.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/system/system_fixture.h"
#include "tools/experiments/separate_run.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Up : public SystemTest {
 protected:
  template <class Condition>
  static bool within(double patience_s, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }
  std::int64_t pid_of(const std::string& program) const {
    for (const RunningProcess& process : info().processes) {
      if (process.program == program) return process.pid;
    }
    return 0;
  }
  bool comes_back(const std::string& program, std::int64_t old_pid) const {
    return within(10.0, [&] { return pid_of(program) != old_pid; });
  }
  static std::string read_all(const fs::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
};

TEST_F(Up, RealTimeControllerComesBackWithoutTorqueAndStandsAgainOnlyWhenAsked) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  const std::int64_t old_pid = pid_of("sprung-leg-controller");
  kill_program("sprung-leg-controller");
  ASSERT_TRUE(comes_back("sprung-leg-controller", old_pid)) << said();
  EXPECT_TRUE(within(5.0, [&] { return said().find("torque stays off") != std::string::npos; })) << said();
  EXPECT_THAT(said(), HasSubstr("sprung-leg-controller was started again (1 of at most 3 times)"));
  EXPECT_NE(sprung("stand").status, 0) << "the cause is latched";
  EXPECT_EQ(sprung("clear").status, 0);
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
}

TEST_F(Up, NothingComesBackInLockStep) {
  up("lockstep", "--speed 1");
  kill_program("sprung-motion-planner");
  EXPECT_TRUE(within(5.0, [&] { return said().find("It is not started again") != std::string::npos; }))
      << said();
  EXPECT_THAT(said(), HasSubstr("sprung-motion-planner ended (Killed)"));
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1) << "a process died: the run has failed";
}

TEST_F(Up, RecorderThatDiesComesBackIntoAnotherLogAndLinesAreKeptBesideTheLog) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  const std::string first_log = info().log;
  const std::int64_t old_pid = pid_of("sprung-recorder");
  kill_program("sprung-recorder");
  ASSERT_TRUE(comes_back("sprung-recorder", old_pid)) << said();
  EXPECT_NE(info().log, first_log);
  const std::string second_log = info().log;
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0) << "the robot never noticed";
  EXPECT_GT(fs::file_size(first_log), 0u);
  EXPECT_GT(fs::file_size(second_log), 0u);
  EXPECT_THAT(read_all(fs::path(first_log).replace_extension(".txt")),
              AllOf(HasSubstr("sprung-can-bridge: "), HasSubstr("sprung-up: ")));
}

TEST_F(Up, ProcessWithAnotherConfigurationIsRefusedAndNamed) {
  const fs::path programs = folder_ / "programs";
  fs::create_directories(programs);
  for (const auto& entry : fs::directory_iterator(SPRUNG_BIN_DIR))
    fs::create_symlink(entry.path(), programs / entry.path().filename());
  fs::remove(programs / "sprung-motion-planner");
  std::ofstream(programs / "sprung-motion-planner")
      << "#!/bin/bash\nexec " SPRUNG_BIN_DIR "/sprung-motion-planner \"${@/#best/paper}\"\n";
  chmod((programs / "sprung-motion-planner").c_str(), 0755);
  setenv("SPRUNG_PROGRAMS", programs.c_str(), 1);
  EXPECT_THAT([&] { up("lockstep"); }, testing::ThrowsMessage<std::runtime_error>(
                                           AllOf(HasSubstr("sprung-motion-planner on "),
                                                 HasSubstr("another configuration"), HasSubstr("--preset"))));
}

TEST_F(Up, ProgramThatEndsWhileStartingIsNamedWithItsLastWords) {
  const fs::path programs = folder_ / "programs";
  fs::create_directories(programs);
  for (const auto& entry : fs::directory_iterator(SPRUNG_BIN_DIR))
    fs::create_symlink(entry.path(), programs / entry.path().filename());
  fs::remove(programs / "sprung-torque-estimator");
  std::ofstream(programs / "sprung-torque-estimator") << "#!/bin/sh\necho no torque today; exit 3\n";
  chmod((programs / "sprung-torque-estimator").c_str(), 0755);
  setenv("SPRUNG_PROGRAMS", programs.c_str(), 1);
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
    return within(5.0, [&] {
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
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_TRUE(listen("STOPPING=1")) << heard;
  close(fd);
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) unsetenv(name);
}

/// Two launchers on one machine, each with a run folder of its own, play two hosts.
class UpOnTwoHosts : public Up {
 protected:
  void SetUp() override {
    Up::SetUp();
    const fs::path robot = folder_ / "robots" / "single_leg";
    fs::create_directories(robot);
    fs::copy(robot_.folder, robot, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::string text = read_all(robot / "robot.yaml");
    const std::string planner = "{program: sprung-motion-planner,";
    const std::size_t at = text.find(planner);
    ASSERT_NE(at, std::string::npos);
    text.insert(at + planner.size(), " host: trunk,");
    std::ofstream(robot / "robot.yaml") << text;
    setenv("SPRUNG_ROBOTS", (folder_ / "robots").c_str(), 1);
  }
  void TearDown() override {
    if (trunk_) trunk_->stop(10.0);
    Up::TearDown();
    unsetenv("SPRUNG_ROBOTS");
  }
  void start_trunk(const std::string& more = "") {
    trunk_ = std::make_unique<ChildProcess>(
        "/bin/sh",
        std::vector<std::string>{"-c", "exec " SPRUNG_BIN_DIR
                                       "/sprung up single_leg --sim --clock lockstep --no-record --host trunk"
                                       " --instance trunk --lcm-url '" +
                                           lcm_url() + "' " + more + " > " +
                                           (folder_ / "trunk.txt").string() + " 2>&1"});
  }
  std::string trunk_said() const { return read_all(folder_ / "trunk.txt"); }
  std::unique_ptr<ChildProcess> trunk_;
};

TEST_F(UpOnTwoHosts, EachStartsItsOwnAndTheSecondEndsWithTheFirst) {
  start_trunk();
  up("lockstep", "--speed 2");
  EXPECT_EQ(pid_of("sprung-motion-planner"), 0) << "the planner is the other host's";
  EXPECT_TRUE(within(5.0, [&] { return trunk_said().find("is up: 1 processes") != std::string::npos; }))
      << trunk_said();
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_TRUE(trunk_->wait(10.0)) << "it goes on without its lead";
}

TEST_F(UpOnTwoHosts, HostThatIsMissingIsNamedWithWhatToTypeThere) {
  EXPECT_THAT([&] { up("lockstep", "--patience 1"); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("sprung-motion-planner is not ready"),
                        HasSubstr("sprung up single_leg --host trunk"), HasSubstr("ttl"))));
}

TEST_F(UpOnTwoHosts, AnotherRobotFileOnTheSecondHostIsRefusedAndNamed) {
  start_trunk("--preset paper");
  EXPECT_THAT([&] { up("lockstep", "--patience 3"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("sprung-motion-planner")));
  EXPECT_TRUE(trunk_->wait(15.0));
  EXPECT_THAT(trunk_said(), HasSubstr("another configuration"));
}

}  // namespace
}  // namespace sprung
