#pragma once
/// A log's cycles with their joint states, made ahead in a thread of its own: file, grouping by cycle and
/// estimator are there while the caller works on the cycles before. What comes, and in which order, does not
/// depend on the threads. Shell: reads a file.
///
///   CycleFeed feed(path, to_s, robot, estimator);
///   while (CycleBatch* batch = feed.next()) use(*batch);
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tools/logs/log/reader.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/replay/batch_ring.h"
#include "tools/logs/replay/estimator_replay.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

struct ReplayCycle {
  LoggedCycle logged;
  EstimatedCycle estimated;
};

struct CycleBatch {
  std::vector<ReplayCycle> cycles;  ///< of which `count` count; the others are memory for the next ones
  std::size_t count = 0;
  std::optional<std::uint64_t> position;  ///< bytes of the file that are done with; only now and then
};

class CycleFeed {
 public:
  /// @param to_s later cycles are left out. @param estimator is this thread's as long as the feed lives.
  /// @throws std::runtime_error where the file cannot be opened.
  CycleFeed(const std::string& log, double to_s, const RobotConfig& robot, EstimatorReplay& estimator);
  ~CycleFeed();  ///< ends the thread, also in the middle of the log
  CycleFeed(const CycleFeed&) = delete;
  CycleFeed& operator=(const CycleFeed&) = delete;

  /// The next cycles; those before are gone. @return nullptr at the end. @throws what reading or the
  /// estimator threw, after the cycles before it: as if they were made only now.
  CycleBatch* next();

  std::uint64_t file_bytes() const noexcept { return reader_.file_bytes(); }
  /// Once next() has returned nullptr:
  const LogFlaws& flaws() const noexcept { return cycles_.flaws(); }
  std::uint64_t damage_count() const noexcept { return reader_.damage_count(); }

 private:
  void run() noexcept;
  void read_all();
  void take(LoggedCycle& cycle);
  void hand_over(std::optional<std::uint64_t> position);

  log::Reader reader_;
  log::Timeline timeline_;
  LogCycles cycles_;
  const double to_s_;
  EstimatorReplay& estimator_;
  BatchRing<CycleBatch> ring_;
  CycleBatch* filling_ = nullptr;  ///< the thread's; nullptr: the caller wants no more
  bool given_ = false;             ///< the caller has a batch
  std::thread thread_;             ///< last: all else is there when it begins
};

}  // namespace sprung
