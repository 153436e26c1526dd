#include "tests/system/system_fixture.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "runtime/own_port.h"
#include "tests/support/paths.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {

namespace {

using Clock = std::chrono::steady_clock;

std::string read_all(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool runs(std::int64_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string id, program, state;
  return stat >> id >> program >> state && state != "Z";
}

}  // namespace

void SystemTest::SetUp() {
  setenv("SPRUNG_PROGRAMS", test::bin_dir().c_str(), 1);
  setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
  setenv("SPRUNG_MIXED_BUILDS", "1",
         1);  // behaviour is tested here, while the tree is worked on and built in parts
  can_address_ = "udp:239.74.163.2:" + std::to_string(own_port());
  lcm_url_ = lcm_url_on_port(own_port());
}

void SystemTest::TearDown() {
  if (up_) {
    up_->stop(kTimeout_s);
  }
  for (const RunningProcess& process : started_) {
    EXPECT_FALSE(runs(process.pid)) << process.program << " was left behind";
  }
  if (HasFailure() && up_) {
    std::printf("sprung up said:\n%s\n", read_all(folder_ / "up.txt").c_str());
  }
  // .ci/second-try looks for these words.
  if (HasFailure() && machine_stalled())
    std::printf("the machine stalled for %.0f ms, longer than real time bears\n", longest_stall_ms());
}

CommandResult SystemTest::sprung(const std::string& arguments) const {
  const std::filesystem::path file = folder_ / "output.txt";
  // In braces: a command may send its progress lines elsewhere.
  const int raw = std::system(
      ("{ " + test::bin_dir() + "/sprung " + arguments + "; } > " + file.string() + " 2>&1").c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), read_all(file)};
}

std::string SystemTest::can_options() const {
  std::string options;
  for (const BusConfig& bus : robot_.buses) {
    const bool first = &bus == robot_.buses.data();
    const std::string address = first ? can_address_ : "udp:239.74.163.2:" + std::to_string(own_port());
    options += " --can " + bus.name + "=" + address;
  }
  return options;
}

std::string SystemTest::said() const { return read_all(folder_ / "up.txt"); }

void SystemTest::up(const std::string& clock, const std::string& more) {
  if (clock == "realtime") stalls_ = std::make_unique<StallWatch>();
  const std::string command = "exec " + test::bin_dir() + "/sprung up " +
                              (typed_robot_.empty() ? robot_.name : typed_robot_) + " --sim --clock " +
                              clock +
                              (log_folder_.empty() ? " --no-record" : " --log " + log_folder_.string()) +
                              " --lcm-url '" + lcm_url_ + "'" + can_options() + " " + more + " > " +
                              (folder_ / "up.txt").string() + " 2>&1";
  up_ = std::make_unique<ChildProcess>("/bin/sh", std::vector<std::string>{"-c", command});
  while (read_all(folder_ / "up.txt").find("is up") == std::string::npos) {
    if (up_->ended()) {
      throw std::runtime_error("sprung up ended: " + read_all(folder_ / "up.txt"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  started_ = info().processes;
}

int SystemTest::wait_for_up(double timeout_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  while (!up_->ended()) {
    if (Clock::now() > end) {
      ADD_FAILURE() << "sprung up did not end";
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return *up_->ended();
}

bool SystemTest::all_end(double timeout_s) const {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  const auto any_runs = [&] {
    return std::any_of(started_.begin(), started_.end(),
                       [](const RunningProcess& process) { return runs(process.pid); });
  };
  while (any_runs() && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return !any_runs();
}

RunInfo SystemTest::info() const { return require_running("default", robot_.name); }

bool SystemTest::grows(const std::filesystem::path& file, std::uintmax_t bytes) {
  const auto end = Clock::now() + std::chrono::duration<double>(kTimeout_s);
  std::error_code not_there_yet;
  const auto long_enough = [&] {
    const std::uintmax_t size = std::filesystem::file_size(file, not_there_yet);
    return !not_there_yet && size > bytes;
  };
  while (!long_enough() && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return long_enough();
}

void SystemTest::kill_program(const std::string& program) const {
  for (const RunningProcess& process : info().processes) {
    if (process.program == program) {
      kill(static_cast<pid_t>(process.pid), SIGKILL);
      return;
    }
  }
  FAIL() << "no process " << program;
}

}  // namespace sprung
