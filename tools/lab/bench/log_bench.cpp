#include "tools/lab/bench/log_bench.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "runtime/message_layout.h"
#include "tools/lab/bench/stopwatch.h"
#include "tools/lab/gait/legged_trial.h"
#include "tools/logs/log/big_endian.h"
#include "tools/logs/log/csv_export.h"
#include "tools/logs/log/mcap_export.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/log/verify.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/inprocess_log.h"

namespace sprung {

namespace {

constexpr double kLeastInfo_MB_s = 200.0;  // issue 7
constexpr double kLeastCsv_MB_s = 50.0;
constexpr double kLeastMcap_MB_s = 100.0;  // issue 7
constexpr double kMostMemory_MB = 100.0;
constexpr double kMega = 1e6;

/// Robots that are made as long as this lives are recorded.
class Recorded {
 public:
  explicit Recorded(const std::string& folder) {
    InProcessRobot::observe_all_by(logs_into(folder, "sprung bench log"));
  }
  ~Recorded() { InProcessRobot::observe_all_by({}); }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;
};

/// As it comes from the kernel, in pieces as large as the reader's.
void read_alone(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw std::runtime_error("cannot read " + path);
  std::vector<char> buffer(log::ReaderOptions().buffer_bytes);
  std::uint64_t sum = 0;
  for (ssize_t got = 1; got > 0; sum += static_cast<std::uint64_t>(buffer[0]))
    got = read(file, buffer.data(), buffer.size());
  close(file);
  keep(sum);
}

void make_table(const std::string& path, const std::vector<std::string>& fields) {
  log::Reader reader(path);
  std::uint64_t bytes = 0;
  log::export_csv(reader, log::FieldSelection(fields), {}, {},
                  [&bytes](std::string_view text) { bytes += text.size(); });
  keep(bytes);
}

/// @return its bytes.
std::uint64_t make_mcap(const std::string& path) {
  log::Reader reader(path);
  log::ChannelFilter all({});
  std::uint64_t bytes = 0;
  log::McapWriter writer([&bytes](std::string_view part) { bytes += part.size(); }, "sprung bench log");
  log::export_mcap(reader, all, writer);
  writer.finish();
  return bytes;
}

double peak_memory_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / kMega;  // the kernel says kB of 1024
}

}  // namespace

std::string record_short_log(const RobotConfig& robot, double duration_s, const std::string& folder) {
  const Recorded recorded(folder);
  LeggedTrial trial(robot, robot.preset().name, lying(SimOptions{1, {}, true}));
  trial.stand_up();
  trial.run(duration_s);
  return (std::filesystem::path(folder) / (robot.name + "-000.lcm")).string();
}

void repeat_log(const std::string& log, const std::string& out, std::uint64_t bytes) {
  log::Reader reader(log);
  log::Writer writer(out);
  log::StampReader stamps;
  std::vector<std::uint8_t> data;
  std::int64_t last_us = 0, shift_us = 0;
  for (std::int64_t round = 0; writer.bytes() < bytes; ++round) {
    const std::int64_t before = writer.events();
    for (log::Event event; writer.bytes() < bytes && reader.next(event);) {
      data.assign(event.data, event.data + event.size);
      if (const auto stamp = stamps.read(data.data(), data.size()))
        log::put_big_endian(static_cast<std::uint64_t>(stamp->session + round), data.data() + kSessionOffset);
      last_us = event.time_us + shift_us;
      writer.write(last_us, event.channel, data.data(), data.size());
    }
    if (writer.events() == before) throw std::invalid_argument(log + " holds no event: give another --log");
    reader.rewind();
    log::Event first;
    if (reader.next(first)) shift_us = last_us - first.time_us + 1;
    reader.rewind();
  }
  writer.close();
}

std::vector<ReportRow> bench_log(const std::string& log, int runs) {
  const double size_MB = static_cast<double>(std::filesystem::file_size(log)) / kMega;
  std::vector<ReportRow> rows;
  const auto measure_MB_s = [&](const std::string& name, double least_MB_s,
                                const std::function<void()>& work) {
    std::vector<double> speeds;
    speeds.reserve(runs);
    for (int run = 0; run < runs; ++run) speeds.push_back(size_MB / (1e-9 * time_ns(work)));
    rows.push_back(
        row("log." + name, "MB/s", median(speeds), demanded(least_MB_s > 0.0, at_least(least_MB_s))));
  };
  rows.push_back(row("log.size", "MB", size_MB));
  read_alone(log);  // brings it into the page cache
  measure_MB_s("read_alone", 0.0, [&] { read_alone(log); });
  measure_MB_s("info", kLeastInfo_MB_s, [&] {
    log::Reader reader(log);
    keep(static_cast<std::uint64_t>(log::collect_info(reader).events));
  });
  measure_MB_s("verify", 0.0, [&] {
    log::Reader reader(log);
    keep(static_cast<std::uint64_t>(log::verify(reader).events));
  });
  measure_MB_s("csv_torques", kLeastCsv_MB_s, [&] {
    make_table(log, {"JOINT_STATE.joints[*].gear_output_torque_Nm", "MOTION_STATE.state"});
  });
  measure_MB_s("csv_everything", kLeastCsv_MB_s, [&] { make_table(log, {}); });
  std::uint64_t mcap_bytes = 0;
  measure_MB_s("mcap", kLeastMcap_MB_s, [&] { mcap_bytes = make_mcap(log); });
  rows.push_back(row("log.mcap_size", "MB", static_cast<double>(mcap_bytes) / kMega));
  rows.push_back(row("log.memory", "MB", peak_memory_MB(), at_most(kMostMemory_MB)));
  return rows;
}

}  // namespace sprung
