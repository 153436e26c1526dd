#pragma once
/// A robot that `sprung up` runs, and what tests do to its processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {

class Up : public SystemTest {
 protected:
  template <class Condition>
  static bool within(double timeout_s, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
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
    return within(kTimeout_s, [&] { return pid_of(program) != old_pid; });
  }
  static std::string read_all(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  bool says(const std::string& what, double timeout_s = kTimeout_s) const {
    return within(timeout_s, [&] { return said().find(what) != std::string::npos; });
  }
  void signal_program(const std::string& program, int number) const {
    kill(static_cast<pid_t>(pid_of(program)), number);
  }
  /// One well-formed datagram of the robot's network that is no message.
  void send_no_message(const std::string& channel) const {
    lcm_t* const lcm = lcm_create(lcm_url().c_str());
    ASSERT_NE(lcm, nullptr);
    lcm_publish(lcm, channel.c_str(), "no message", 10);
    lcm_destroy(lcm);
  }
  /// Stops it for so long, again and again, until `status` says that.
  bool stalled(const std::string& program, int stop_ms, const std::string& says) const {
    return within(kTimeout_s, [&] {
      signal_program(program, SIGSTOP);
      std::this_thread::sleep_for(std::chrono::milliseconds(stop_ms));
      signal_program(program, SIGCONT);
      return sprung("status").output.find(says) != std::string::npos;
    });
  }
  /// From now on `program` is this shell script; every other one is as built.
  void replace_program(const std::string& program, const std::string& script) const {
    const std::filesystem::path programs = folder_ / "programs";
    if (!std::filesystem::exists(programs)) {
      std::filesystem::create_directories(programs);
      for (const auto& entry : std::filesystem::directory_iterator(test::bin_dir()))
        std::filesystem::create_symlink(entry.path(), programs / entry.path().filename());
    }
    std::filesystem::remove(programs / program);
    std::ofstream(programs / program) << "#!/bin/bash\n" << script << "\n";
    chmod((programs / program).c_str(), 0755);
    setenv("SPRUNG_PROGRAMS", programs.c_str(), 1);
  }
  std::string info_of_log(const std::string& log) const { return sprung("log info " + log).output; }
  std::size_t logs() const {
    const auto is_log = [](const std::filesystem::directory_entry& entry) {
      return entry.path().extension() == ".lcm";
    };
    return static_cast<std::size_t>(std::count_if(std::filesystem::directory_iterator(log_folder_),
                                                  std::filesystem::directory_iterator(), is_log));
  }
};

}  // namespace sprung
