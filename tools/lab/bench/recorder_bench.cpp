#include "tools/lab/bench/recorder_bench.h"

#include <lcm/lcm.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>

#include "runtime/own_port.h"
#include "tools/logs/log/reader.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kBytes = 344;  // of a message: about that of JOINT_STATE of one leg
constexpr double kReadyTimeout_s = 10.0;
constexpr auto kQuiet = std::chrono::milliseconds(500);  // what is on its way arrives
const char* const kChannels[] = {"BENCH_0", "BENCH_1", "BENCH_2", "BENCH_3", "BENCH_4"};

void wait_for_file(const std::string& path) {
  const auto end = Clock::now() + std::chrono::duration<double>(kReadyTimeout_s);
  while (!fs::exists(path)) {
    if (Clock::now() > end) throw std::runtime_error(path + " was not begun");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Take the processor until they are stopped.
class Hogs {
 public:
  explicit Hogs(int count) {
    for (int i = 0; i < count; ++i)
      hogs_.push_back(
          std::make_unique<ChildProcess>("/bin/sh", std::vector<std::string>{"-c", "while :; do :; done"}));
  }
  ~Hogs() {
    for (const auto& hog : hogs_) hog->stop(1.0);
  }
  Hogs(const Hogs&) = delete;
  Hogs& operator=(const Hogs&) = delete;

 private:
  std::vector<std::unique_ptr<ChildProcess>> hogs_;
};

void send(const std::string& url, const RecorderBench& bench) {
  const std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm(lcm_create(url.c_str()), lcm_destroy);
  if (!lcm) throw std::runtime_error("LCM could not start on " + url + ": run 'sprung doctor'");
  std::vector<std::uint8_t> message(kBytes);
  const auto start = Clock::now();
  for (int i = 0; i < bench.messages; ++i) {
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(i / bench.rate_Hz)));
    std::memcpy(message.data(), &i, sizeof i);
    lcm_publish(lcm.get(), kChannels[i % 5], message.data(), static_cast<unsigned>(message.size()));
  }
}

/// Messages of the bench that a log has.
int count(const std::string& path) {
  log::Reader reader(path);
  int found = 0;
  for (log::Event event; reader.next(event);) found += event.channel.substr(0, 6) == "BENCH_" ? 1 : 0;
  return found;
}

struct Lost {
  int own = 0;
  int lcm_logger = 0;
};

Lost run_once(const RecorderBench& bench, int run) {
  const std::string url = lcm_url_on_port(own_port());
  const std::string stem = (fs::path(bench.folder) / ("run-" + std::to_string(run))).string();
  const std::string own = stem + "-sprung.lcm", theirs = stem + "-lcm-logger.lcm";
  fs::remove(own);  // of a bench that was interrupted
  fs::remove(theirs);
  {
    ChildProcess recorder(program_folder() + "/sprung-recorder",
                          {"--robot", "single_leg", "--session", "1", "--lcm-url", url, "--file", own},
                          Output::kCaptured);
    ChildProcess logger(system_program("lcm-logger", "liblcm-bin"), {"--lcm-url=" + url, "-q", "-f", theirs});
    wait_for_file(own);
    wait_for_file(theirs);
    std::this_thread::sleep_for(kQuiet);
    {
      const Hogs hogs(bench.hogs);
      send(url, bench);
      std::this_thread::sleep_for(kQuiet);
    }
    std::this_thread::sleep_for(kQuiet);
    recorder.stop(kReadyTimeout_s);
    logger.stop(kReadyTimeout_s);
  }
  const Lost lost{bench.messages - count(own), bench.messages - count(theirs)};
  fs::remove(own);
  fs::remove(theirs);
  return lost;
}

}  // namespace

std::vector<ReportRow> bench_recorder(const RecorderBench& bench) {
  fs::create_directories(bench.folder);
  Lost all, worst;
  for (int run = 0; run < bench.runs; ++run) {
    if (bench.on_run) bench.on_run(run);
    const Lost lost = run_once(bench, run);
    all.own += lost.own;
    all.lcm_logger += lost.lcm_logger;
    worst.own = std::max(worst.own, lost.own);
    worst.lcm_logger = std::max(worst.lcm_logger, lost.lcm_logger);
  }
  const double sent = static_cast<double>(bench.runs) * bench.messages;
  std::vector<ReportRow> rows{row("recorder.sent", "messages", sent),
                              row("recorder.lost", "messages", all.own, between(0.0, 0.0)),
                              row("recorder.lost_in_worst_run", "messages", worst.own),
                              row("recorder.lcm_logger_lost", "messages", all.lcm_logger),
                              row("recorder.lcm_logger_lost_in_worst_run", "messages", worst.lcm_logger)};
  // Nothing against nothing is no ratio.
  rows.push_back(row("recorder.lost_ratio", "-",
                     all.lcm_logger > 0 ? static_cast<double>(all.own) / all.lcm_logger : NAN));
  return rows;
}

}  // namespace sprung
