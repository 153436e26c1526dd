/// sprung-recorder: every message on the robot's network into LCM logs.
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "runtime/log.h"
#include "runtime/process.h"
#include "runtime/stop_request.h"
#include "tools/logs/recorder/log_metadata.h"
#include "tools/logs/recorder/log_quota.h"
#include "tools/logs/recorder/network_tap.h"
#include "tools/logs/recorder/news_pace.h"
#include "tools/logs/recorder/recording_report.h"

namespace sprung {
namespace {

/// How long messages are gathered before they are written: few large turns cost less than one for each
/// message.
constexpr int kTurn_ms = 20;
/// What was written is handed to the kernel, and the disk looked at, this often.
constexpr std::int64_t kTick_us = 100'000;
/// Older logs are looked through this often.
constexpr std::int64_t kRoom_us = 5'000'000;
/// Ahead of all that is not in real time: the kernel holds what is not taken for about a second, then it is
/// lost.
constexpr int kNice = -15;
/// Where the launcher died: how long the others may be silent, and how long the recorder outlives them at
/// most.
constexpr std::int64_t kQuiet_us = 3'000'000;  // in lock-step the bridge waits a second for a command and
                                               // another for its drives, and says nothing
constexpr std::int64_t kLongestLife_us = 8'000'000;

struct RecorderOptions {
  std::string file = "recording.lcm";
  std::string channels = ".*";
  std::string command_line;
  double split_MB = 0.0;
  double split_min = 0.0;
  double least_free_MB = 500.0;
  double keep_MB = 0.0;

  RecordingOptions recording() const {
    const auto bytes = [](double megabytes) { return static_cast<std::uint64_t>(megabytes * 1e6); };
    if (!(split_MB >= 0.0 && split_min >= 0.0 && least_free_MB >= 0.0 && keep_MB >= 0.0))
      throw WrongUse("--split-mb, --split-min, --min-free-mb and --keep-mb are 0 or more");
    return {file, bytes(split_MB), std::llround(split_min * 60e6), bytes(least_free_MB), true};
  }
};

RecordedRun recorded_run(const Process& process, const RecorderOptions& options, std::int64_t utime_us) {
  const ProcessOptions& run = process.options();
  return {run.preset, run.clock, run.simulation,       run.node.session,
          utime_us,   utc_us(),  options.command_line, run.node.lcm_url};
}

/// For this thread and those that it starts. Without the right to it the recorder is one of many.
void go_ahead_of_others() {
  if (setpriority(PRIO_PROCESS, 0, kNice) != 0)
    log_debug("not allowed to run at nice -15: messages may be lost on a very busy machine");
}

/// Writes what the tap brings until the recording ends.
class Recorder {
 public:
  Recorder(Process& process, const RecorderOptions& options)
      : process_(process),
        recording_(
            options.recording(),
            make_log_metadata(process.robot(), recorded_run(process, options, process.node().utime_us()))),
        keep_bytes_(static_cast<std::uint64_t>(options.keep_MB * 1e6)),
        tap_(process.options().node.lcm_url, options.channels, queue_) {}

  int run() {
    process_.set_state(ProcessState::kReady);
    while (!stop_requested() && !recording_.ended()) {
      wait();
      write_what_came();
      tick();
      process_.publish_status_if_due();
    }
    if (launcher_died()) outlive_the_others();
    finish();
    return recording_.ended() == LogEndReason::kAsked ? kExitDone : kExitFailed;
  }

 private:
  void wait() const {
    pollfd stop{stop_fd(), POLLIN, 0};
    poll(&stop, 1, kTurn_ms);
  }

  void write_what_came() {
    queue_.take(batch_);
    batch_.for_each([this](std::int64_t time_us, std::string_view channel, const std::uint8_t* data,
                           std::size_t size) { recording_.add(time_us, channel, data, size); });
    if (batch_.size() > 0 && process_.status().state == ProcessState::kReady)
      process_.set_state(ProcessState::kRunning);
    process_.status().sequence_gaps = recording_.missing();
  }

  void tick() {
    const std::int64_t now_us = process_.node().utime_us();
    if (now_us < next_tick_us_) return;
    next_tick_us_ = now_us + kTick_us;
    recording_.tick(utc_us());
    make_room(now_us);
    if (!news_pace_.due(now_us)) return;
    const std::string news = recording_.take_news();
    news_pace_.asked(now_us, !news.empty());
    if (!news.empty()) log_warn(news);
  }

  void make_room(std::int64_t now_us) {
    if (keep_bytes_ == 0 || now_us < next_room_us_) return;
    next_room_us_ = now_us + kRoom_us;
    const std::string& own = recording_.files().back();
    const std::string folder = std::filesystem::path(own).parent_path();
    for (const std::string& gone : remove_oldest_logs(folder, keep_bytes_, own))
      log_info("removed the oldest log for --keep-mb: " + gone);
  }

  /// The signal of its death comes when its first thread ends; as long as another is left, it still counts as
  /// the parent.
  bool launcher_died() {
    constexpr int kTurns = 15;
    for (int i = 0; i < kTurns && getppid() == launcher_; ++i) {
      poll(nullptr, 0, kTurn_ms);
      write_what_came();
    }
    return getppid() != launcher_;
  }

  /// All were told to end at once. The bridge brings its drives to rest first, and what it says belongs in
  /// the log.
  void outlive_the_others() {
    const std::int64_t began_us = process_.node().utime_us();
    std::int64_t heard_us = began_us, now_us = began_us;
    while (now_us - heard_us < kQuiet_us && now_us - began_us < kLongestLife_us && !recording_.ended()) {
      poll(nullptr, 0, kTurn_ms);
      write_what_came();
      now_us = process_.node().utime_us();
      if (batch_.size() > 0) heard_us = now_us;
    }
  }

  void finish() {
    tap_.stop();
    write_what_came();
    recording_.end(utc_us(), LogEndReason::kAsked, "ended in order");
    if (recording_.ended() != LogEndReason::kAsked) {
      process_.status().detail = recording_.detail();
      log_error("recording ended: " + recording_.detail());
    }
    std::printf("%s", recording_report(recording_, queue_.longest()).c_str());
    std::fflush(stdout);
  }

  const pid_t launcher_ = getppid();
  Process& process_;
  Recording recording_;
  MessageQueue queue_;
  MessageQueue::Batch batch_;
  std::int64_t next_tick_us_ = 0;
  std::uint64_t keep_bytes_;  ///< 0: all logs stay
  std::int64_t next_room_us_ = 0;
  NewsPace news_pace_;
  NetworkTap tap_;  ///< last: its thread ends before the queue does
};

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  sprung::RecorderOptions options;
  return sprung::run_process(
      argc, argv,
      {"sprung-recorder",
       "Every message on the robot's network into LCM logs; loses none, and says so if it did.", true},
      [&](sprung::Process& process) {
        sprung::go_ahead_of_others();
        return sprung::Recorder(process, options).run();
      },
      [&](sprung::CommandLine& line) {
        line.option("--file", options.file,
                    "LCM log to write; with a split x.lcm becomes x-000.lcm, x-001.lcm, ...");
        line.option("--channels", options.channels, "regular expression, as LCM's");
        line.option("--split-mb", options.split_MB, "begin another file at this size, MB; 0 = never");
        line.option("--split-min", options.split_min,
                    "begin another file after this time, minutes; 0 = never");
        line.option("--min-free-mb", options.least_free_MB,
                    "end before the disk has less than this left, MB; 0 = never");
        line.option("--keep-mb", options.keep_MB,
                    "logs of the file's folder that are kept, MB: beyond it the oldest are removed; 0 = all");
        line.option("--command-line", options.command_line, "for LOG_METADATA: what started the recording");
      });
}
