/// What `sprung up` does with its recorder: the robot never depends on it.
#include <fcntl.h>
#include <unistd.h>

#include "tests/system/up_fixture.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(Up, RecorderHasTimeToWriteWhatItHolds) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  const auto recorder = static_cast<pid_t>(pid_of("sprung-recorder"));
  kill(recorder, SIGSTOP);  // a disk that takes nothing for a while
  std::thread disk([recorder] {
    std::this_thread::sleep_for(std::chrono::milliseconds(4500));
    kill(recorder, SIGCONT);
  });
  EXPECT_EQ(sprung("down").status, 0);
  disk.join();
  EXPECT_EQ(wait_for_up(), 0) << said();
  EXPECT_THAT(said(), HasSubstr("sprung-recorder: recorded "));
}

TEST_F(Up, RecorderThatCannotComeBackDoesNotEndTheRun) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  fs::remove_all(log_folder_);
  std::ofstream(log_folder_) << "no folder any more";
  kill_program("sprung-recorder");
  EXPECT_TRUE(says("sprung-recorder is not started again: ")) << said();
  EXPECT_EQ(sprung("stand").status, 0);
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1) << "there is no log";
}

TEST_F(Up, RecorderThatEndsForAFullDiskStaysEndedAndTheRobotGoesOn) {
  log_folder_ = folder_ / "logs";
  fs::create_directories(log_folder_);
  constexpr double kMargin_MB = 200.0;
  const double least_MB = static_cast<double>(fs::space(log_folder_).available) * 1e-6 - kMargin_MB;
  up("lockstep", "--speed 1 --min-free-mb " + std::to_string(least_MB));
  const std::string log = info().log;
  const int fd = open((log_folder_ / "ballast").c_str(), O_CREAT | O_WRONLY, 0600);
  ASSERT_EQ(posix_fallocate(fd, 0, static_cast<off_t>(2.0 * kMargin_MB * 1e6)), 0);
  EXPECT_TRUE(says("sprung-recorder ended (exit status 1). The run goes on without a log")) << said();
  close(fd);
  EXPECT_THAT(said(), HasSubstr("recording ended: less than"));
  EXPECT_EQ(sprung("stand").status, 0);
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 1);
  EXPECT_EQ(said().find("started again ("), std::string::npos) << said();
  EXPECT_EQ(logs(), 1u);
  EXPECT_EQ(info_of_log(log).find("cut off"), std::string::npos);
  EXPECT_THAT(said(), HasSubstr("log: " + log));
}

TEST_F(Up, LogIsSplitAsAskedAndTheFirstPartIsNamed) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1 --split-mb 0.3 --channels 'JOINT_STATE|PROCESS_STATUS|MOTION_STATE'");
  const std::string first = info().log;
  EXPECT_THAT(first, testing::EndsWith("-000.lcm"));
  EXPECT_TRUE(within(kTimeout_s, [&] { return logs() >= 3; }));
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0);
  EXPECT_THAT(said(), HasSubstr("log: " + first));
  EXPECT_GT(fs::file_size(first), 200'000u);
  EXPECT_EQ(info_of_log(first).find("DRIVE_STATE"), std::string::npos);
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

}  // namespace
}  // namespace sprung
