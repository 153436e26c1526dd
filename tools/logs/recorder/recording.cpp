#include "tools/logs/recorder/recording.h"

#include <sys/statvfs.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "lcmtypes/channels.h"

namespace sprung {

namespace {

/// The disk is looked at each time that this much was written.
constexpr std::uint64_t kLook_bytes = std::uint64_t{1} << 20;

std::string in_megabytes(std::uint64_t bytes) { return std::to_string(bytes / 1'000'000) + " MB"; }

}  // namespace

std::string part_path(const RecordingOptions& options, int part) {
  if (!options.splits()) return options.path;
  const std::filesystem::path path(options.path);
  char number[16];
  std::snprintf(number, sizeof number, "-%03d", part);
  return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

std::uint64_t free_disk_bytes(const std::string& path) {
  struct statvfs disk {};
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (statvfs(path.c_str(), &disk) != 0 && statvfs(folder.empty() ? "." : folder.c_str(), &disk) != 0)
    throw std::runtime_error("cannot ask how much room there is for " + path + ": " + std::strerror(errno));
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
}

Recording::Recording(const RecordingOptions& options, const sprung_msgs::log_metadata_t& metadata,
                     FreeBytes free_bytes)
    : options_(options), metadata_(metadata), free_bytes_(std::move(free_bytes)) {
  check_place();
  begin_part(metadata.utc_us);
}

/// Before a file is made, or emptied.
void Recording::check_place() const {
  const std::string file = part_path(options_, 0);
  std::error_code none;  // there is no such file, or it cannot be seen: making it will tell
  if (options_.keep_existing && std::filesystem::is_regular_file(file, none) &&
      std::filesystem::file_size(file, none) > 0)
    throw std::runtime_error(file + " is there already: give another name, or remove it");
  if (disk_is_full(file))
    throw std::runtime_error("less than " + in_megabytes(options_.least_free_bytes) + " are free where " +
                             file + " would be: make room, or record to another disk");
}

void Recording::begin_part(std::int64_t time_us) {
  files_.push_back(part_path(options_, part_));
  if (writer_) earlier_bytes_ += writer_->bytes();
  writer_.emplace(files_.back());
  metadata_.part = part_++;
  metadata_.seq = -1;
  const std::vector<std::uint8_t> bytes = message_bytes(metadata_);
  writer_->write(time_us, channels::kLogMetadata, bytes.data(), bytes.size());
  writer_->flush();
  part_began_us_ = time_us;
  looked_at_bytes_ = 0;
}

void Recording::end_part(std::int64_t time_us, LogEndReason reason, const std::string& detail) {
  sprung_msgs::log_end_t end{};
  end.session = metadata_.session;
  end.utime = metadata_.utime + (time_us - metadata_.utc_us);
  end.seq = -1;
  end.events = writer_->events();
  end.missing = missing();
  end.reason = static_cast<std::int8_t>(reason);
  end.detail = detail;
  const std::vector<std::uint8_t> bytes = message_bytes(end);
  writer_->write(time_us, channels::kLogEnd, bytes.data(), bytes.size());
  writer_->close();
}

void Recording::add(std::int64_t time_us, std::string_view channel, const std::uint8_t* data,
                    std::size_t size) {
  if (ended_) return;
  try {
    writer_->write(time_us, channel, data, size);
    ++events_;
    count(channel, data, size);
    if (writer_->bytes() - looked_at_bytes_ >= kLook_bytes) tick(time_us);
    const bool long_enough = options_.split_us > 0 && time_us - part_began_us_ >= options_.split_us;
    const bool big_enough = options_.split_bytes > 0 && writer_->bytes() >= options_.split_bytes;
    if (ended_ || !(long_enough || big_enough)) return;
    end_part(time_us, LogEndReason::kContinued, "goes on in " + part_path(options_, part_));
    begin_part(time_us);
  } catch (const log::WriteError& error) {
    fail(error.what());
  }
}

void Recording::count(std::string_view channel, const std::uint8_t* data, std::size_t size) {
  auto found = channels_.find(channel);
  if (found == channels_.end())
    found = channels_.emplace(channel, Channel{has_every_cycle(channel), {}, 0}).first;
  ++found->second.messages;
  if (!found->second.cyclic || size < kCountsOffset) return;
  const std::int64_t skipped = found->second.cycles.add(read_int64(data, kSessionOffset),
                                                        read_int64(data, kSeqOffset));
  if (skipped > 0) news_[found->first] += skipped;
}

void Recording::tick(std::int64_t time_us) {
  if (ended_) return;
  try {
    writer_->flush();
    looked_at_bytes_ = writer_->bytes();
    if (disk_is_full(files_.back()))
      end(time_us, LogEndReason::kDiskGuard,
          "less than " + in_megabytes(options_.least_free_bytes) + " are left on the disk of " +
              files_.back());
  } catch (const log::WriteError& error) {
    fail(error.what());
  }
}

void Recording::end(std::int64_t time_us, LogEndReason reason, const std::string& detail) {
  if (ended_) return;
  try {
    end_part(time_us, reason, detail);
    ended_ = reason;
    detail_ = detail;
  } catch (const log::WriteError& error) {
    fail(error.what());
  }
}

bool Recording::disk_is_full(const std::string& path) const {
  if (options_.least_free_bytes == 0) return false;
  try {
    return free_bytes_(path) < options_.least_free_bytes;
  } catch (const std::runtime_error&) {
    return false;  // its folder was moved while it is written: the file is still open, and nothing is lost
  }
}

void Recording::fail(const std::string& what) {
  ended_ = LogEndReason::kWriteError;
  detail_ = what;
}

std::int64_t Recording::missing() const noexcept {
  std::int64_t sum = 0;
  for (const auto& [channel, counts] : channels_) sum += counts.cycles.counts().missing;
  return sum;
}

std::string Recording::take_news() {
  if (news_.empty()) return "";
  std::string out;
  for (const auto& [channel, cycles] : news_)
    out += (out.empty() ? "cycles missing: " : ", ") + channel + " " + std::to_string(cycles);
  news_.clear();
  const bool may_skip = metadata_.clock == "realtime";
  return out + (may_skip ? " (in real time, who comes late skips them)" : "");
}

}  // namespace sprung
