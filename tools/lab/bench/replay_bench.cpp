#include "tools/lab/bench/replay_bench.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "tools/lab/bench/stopwatch.h"
#include "tools/lab/gait/legged_trial.h"
#include "tools/logs/recorder/inprocess_log.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {

namespace {

constexpr double kLeastTimesRealTime = 100.0;  // design section 10

/// Logs of robots that are made as long as this lives.
class LogsInto {
 public:
  explicit LogsInto(const std::string& folder) {
    InProcessRobot::observe_all_by(logs_into(folder, "sprung bench replay"));
  }
  ~LogsInto() { InProcessRobot::observe_all_by({}); }
  LogsInto(const LogsInto&) = delete;
  LogsInto& operator=(const LogsInto&) = delete;
};

void walk(const RobotConfig& robot, double duration_s) {
  LeggedTrial trial(robot, robot.preset().name, lying(SimOptions{1, {}, true}));
  trial.stand_up();
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = gait_index(robot, "trot");
  walk.walk_speed = {0.2, 0.0, 0.1};
  trial.say(walk);
  trial.run(duration_s);
}

/// Of one cycle of the log, us; medians of the runs.
struct CycleTime {
  double wall_us = 0.0;
  double processor_us = 0.0;  ///< what others on the machine take is not in it
};

CycleTime cycle_time(const ReplayRequest& request, int runs) {
  std::vector<double> wall, processor;
  for (int run = 0; run < runs; ++run) {
    const ReplayResult result = run_replay(request);
    const double cycles = static_cast<double>(std::max<std::int64_t>(result.last_logged_seq + 1, 1));
    wall.push_back(1e6 * result.wall_s / cycles);
    processor.push_back(1e6 * result.processor_s / cycles);
  }
  return {median(wall), median(processor)};
}

}  // namespace

std::vector<ReportRow> bench_replay(const RobotConfig& robot, int runs, double duration_s,
                                    const std::string& folder) {
  {
    const LogsInto logs(folder);
    walk(robot, duration_s);
  }
  ReplayRequest request;
  request.log = (std::filesystem::path(folder) / (robot.name + "-000.lcm")).string();
  const ReplayResult result = run_replay(request);
  const CycleTime all = cycle_time(request, runs);
  std::vector<ReportRow> rows;
  const auto add = [&](const std::string& name, const char* unit, double value, const Bounds& bounds = {}) {
    rows.push_back(row("replay." + robot.name + "." + name, unit, value, bounds));
  };
  add("times_real_time", "-", robot.cycle_s * 1e6 / all.wall_us, at_least(kLeastTimesRealTime));
  add("times_real_time_of_processor", "-", robot.cycle_s * 1e6 / all.processor_us);
  add("differing", "messages", static_cast<double>(result.counts.differing), between(0.0, 0.0));
  add("compared", "messages", static_cast<double>(result.counts.compared));
  add("cycle", "us", all.processor_us);
  request.cores.runs = {};
  const double file_us = cycle_time(request, runs).processor_us;
  add("file", "us", file_us);
  for (const Core core : {Core::kEstimator, Core::kPlanner, Core::kController}) {
    request.cores = core_choice(name(core));
    add(name(core), "us", cycle_time(request, runs).processor_us - file_us);
  }
  return rows;
}

}  // namespace sprung
