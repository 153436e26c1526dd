#include "tools/logs/log/rewrite.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <queue>
#include <stdexcept>
#include <vector>

#include "lcmtypes/channels.h"
#include "tools/logs/log/message_check.h"

namespace sprung::log {

namespace {

constexpr std::size_t kBuffers_bytes = std::size_t{32} << 20;  // of all logs that are merged
constexpr std::size_t kLeastBuffer_bytes = std::size_t{64} << 10;

/// Counts what is read, and writes what is to be written.
class Copy {
 public:
  Copy(Writer& writer, const Progress& progress, std::uint64_t all_bytes)
      : writer_(writer), progress_(progress), all_bytes_(all_bytes) {}

  void read(const Event& event) {
    ++result_.read;
    done_bytes_ += event.bytes_in_file();
    if (progress_ && result_.read % kEventsBetween == 0) progress_(done_bytes_, all_bytes_);
  }
  void write(const Event& event) {
    if (event.channel == channels::kLogEnd) return;
    writer_.write(event);
    ++result_.written;
  }
  void bring(const Event& event) {
    write(event);
    ++result_.brought;
  }
  void refuse() { ++result_.refused; }
  void finish(const Reader& reader) {
    result_.damages += reader.damage_count();
    result_.skipped_bytes += reader.skipped_bytes();
  }
  RewriteResult result() {
    writer_.close();
    result_.bytes = writer_.bytes();
    return result_;
  }

 private:
  Writer& writer_;
  const Progress& progress_;
  std::uint64_t all_bytes_;
  std::uint64_t done_bytes_ = 0;
  RewriteResult result_;
};

/// LOG_METADATA that stands outside the stretch comes along at the time of the stretch's first message: with
/// its own, tools that go by the times of events would take the time between for a part of the log.
class BroughtMetadata {
 public:
  explicit BroughtMetadata(Copy& copy) : copy_(copy) {}

  void take(const Event& event) {
    waiting_.push_back({event, {event.data, event.data + event.size}});
    if (begun_) bring_at(newest_us_);
  }
  /// Call it before each message of the stretch is written.
  void before(const Event& event) {
    bring_at(event.time_us);
    newest_us_ = event.time_us;
    begun_ = true;
  }
  void finish() {  ///< of a stretch without messages, as they were
    for (Kept& kept : waiting_) bring(kept);
    waiting_.clear();
  }

 private:
  struct Kept {
    Event event;
    std::vector<std::uint8_t> data;
  };
  void bring_at(std::int64_t time_us) {
    for (Kept& kept : waiting_) kept.event.time_us = time_us;
    finish();
  }
  void bring(Kept& kept) {
    kept.event.channel = channels::kLogMetadata;
    kept.event.data = kept.data.data();
    copy_.bring(kept.event);
  }

  Copy& copy_;
  std::vector<Kept> waiting_;
  bool begun_ = false;
  std::int64_t newest_us_ = 0;  ///< of what is written
};

/// A log and its next event.
struct Stream {
  Stream(const std::string& path, const ReaderOptions& options) : reader(path, options) {}
  Reader reader;
  Event event;
};

/// The first to go is the one received first; of equals the one named first.
struct LaterFirst {
  const std::vector<std::unique_ptr<Stream>>& streams;
  bool operator()(std::size_t a, std::size_t b) const noexcept {
    const std::int64_t time_a = streams[a]->event.time_us, time_b = streams[b]->event.time_us;
    return time_a != time_b ? time_a > time_b : a > b;
  }
};

}  // namespace

void refuse_same_file(const std::vector<std::string>& logs, const std::string& out) {
  for (const std::string& log : logs) {
    std::error_code error;
    if (std::filesystem::equivalent(log, out, error) && !error)
      throw std::invalid_argument(out + " is the log that is read: give the new file another name");
  }
}

RewriteResult copy_part(Reader& reader, const TimeSpan& span, ChannelFilter& filter, Writer& writer,
                        const Progress& progress) {
  const SpanTest test(span, span.needs_end() ? extent_of(reader) : LogExtent{});
  Copy copy(writer, progress, reader.file_bytes());
  BroughtMetadata metadata(copy);
  Timeline timeline;
  for (Event event; reader.next(event);) {
    copy.read(event);
    const double time_s = timeline.next(event).time_s;
    const bool wanted = test.holds(time_s, event.time_us) && filter.keeps(event.channel);
    if (wanted) metadata.before(event);
    if (wanted) copy.write(event);
    if (!wanted && event.channel == channels::kLogMetadata) metadata.take(event);
  }
  metadata.finish();
  copy.finish(reader);
  return copy.result();
}

RewriteResult merge(const std::vector<std::string>& logs, Writer& writer, const Progress& progress) {
  std::vector<std::unique_ptr<Stream>> streams;
  std::uint64_t all_bytes = 0;
  ReaderOptions options;  // the buffers of all together are as many bytes as a few logs have
  options.buffer_bytes = std::clamp(kBuffers_bytes / std::max<std::size_t>(logs.size(), 1),
                                    kLeastBuffer_bytes, options.buffer_bytes);
  for (const std::string& path : logs) {
    streams.push_back(std::make_unique<Stream>(path, options));
    all_bytes += streams.back()->reader.file_bytes();
  }
  Copy copy(writer, progress, all_bytes);
  std::priority_queue<std::size_t, std::vector<std::size_t>, LaterFirst> waiting(LaterFirst{streams});
  const auto fetch = [&](std::size_t i) {
    if (streams[i]->reader.next(streams[i]->event)) {
      waiting.push(i);
    } else {
      copy.finish(streams[i]->reader);
    }
  };
  for (std::size_t i = 0; i < streams.size(); ++i) fetch(i);
  while (!waiting.empty()) {
    const std::size_t first = waiting.top();
    waiting.pop();
    copy.read(streams[first]->event);
    copy.write(streams[first]->event);
    fetch(first);
  }
  return copy.result();
}

RewriteResult repair(Reader& reader, Writer& writer, const Progress& progress) {
  Copy copy(writer, progress, reader.file_bytes());
  MessageCheck messages;
  for (Event event; reader.next(event);) {
    copy.read(event);
    const fields::Fault fault = messages.check(event);
    const bool good = fault == fields::Fault::kNone || fault == fields::Fault::kUnknownType;
    good ? copy.write(event) : copy.refuse();
  }
  copy.finish(reader);
  return copy.result();
}

}  // namespace sprung::log
