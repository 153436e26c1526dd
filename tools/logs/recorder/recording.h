#pragma once
/// A recording: one LCM log, or several in a row, each with LOG_METADATA first and LOG_END last. Ends by
/// itself before the disk is full. Writes files; the free space comes from a function, so that it can be
/// tested.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sprung_msgs/log_metadata_t.hpp"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/gap_tracker.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung {

struct RecordingOptions {
  std::string path;               ///< of the only part; with a split, x.lcm becomes x-000.lcm, x-001.lcm, ...
  std::uint64_t split_bytes = 0;  ///< a part ends with the message that reaches this; 0 = never
  /// A part ends with the message that comes this long after its beginning; 0 = never.
  std::int64_t split_us = 0;
  std::uint64_t least_free_bytes = 0;  ///< the recording ends when the disk has less than this left
  bool keep_existing = false;          ///< refuse to take the place of a file that has something in it

  bool splits() const noexcept { return split_bytes > 0 || split_us > 0; }
};

/// Name of a part's file.
std::string part_path(const RecordingOptions& options, int part);

/// Free bytes of the disk that a path is on, for who is not root; the path itself need not be there, its
/// folder must. @throws std::runtime_error when it cannot be asked.
std::uint64_t free_disk_bytes(const std::string& path);

class Recording {
 public:
  using FreeBytes = std::function<std::uint64_t(const std::string& path)>;

  /// Begins the first part. @param metadata of every part; `part` is filled in here.
  /// @throws log::WriteError where the file cannot be made; std::runtime_error when the disk has too little
  /// room already, or the file is there and shall be kept: then no file was touched.
  Recording(const RecordingOptions& options, const sprung_msgs::log_metadata_t& metadata,
            FreeBytes free_bytes = free_disk_bytes);

  /// @param time_us UTC, when it was received. Does nothing once the recording has ended.
  void add(std::int64_t time_us, std::string_view channel, const std::uint8_t* data, std::size_t size);
  /// Now and then: hands what was gathered to the kernel, and looks at the disk.
  void tick(std::int64_t time_us);
  /// Ends it in order. Does nothing once it has ended.
  void end(std::int64_t time_us, LogEndReason reason, const std::string& detail);

  /// Why it has ended; nothing while it goes on.
  std::optional<LogEndReason> ended() const noexcept { return ended_; }
  const std::string& detail() const noexcept { return detail_; }  ///< one sentence on that

  struct Channel {
    bool cyclic = false;  ///< gaps of the others cannot be told
    SessionGapTracker cycles;
    std::int64_t messages = 0;
  };
  const std::map<std::string, Channel, std::less<>>& channels() const noexcept { return channels_; }
  std::int64_t missing() const noexcept;  ///< cycles, all channels
  std::int64_t events() const noexcept { return events_; }
  std::uint64_t bytes() const noexcept { return earlier_bytes_ + writer_->bytes(); }
  const std::vector<std::string>& files() const noexcept { return files_; }
  /// What went missing since the last call, in words; empty when nothing did.
  std::string take_news();

 private:
  void begin_part(std::int64_t time_us);
  void end_part(std::int64_t time_us, LogEndReason reason, const std::string& detail);
  void count(std::string_view channel, const std::uint8_t* data, std::size_t size);
  void check_place() const;
  bool disk_is_full(const std::string& path) const;
  void fail(const std::string& what);

  RecordingOptions options_;
  sprung_msgs::log_metadata_t metadata_;
  FreeBytes free_bytes_;
  std::optional<log::Writer> writer_;
  int part_ = 0;
  std::int64_t part_began_us_ = 0;
  std::uint64_t looked_at_bytes_ = 0;  ///< of this part when the disk was last looked at
  std::map<std::string, Channel, std::less<>> channels_;
  std::map<std::string, std::int64_t> news_;  ///< missing cycles by channel
  std::int64_t events_ = 0;
  std::uint64_t earlier_bytes_ = 0;  ///< of earlier parts
  std::vector<std::string> files_;
  std::optional<LogEndReason> ended_;
  std::string detail_;
};

}  // namespace sprung
