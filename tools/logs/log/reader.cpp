#include "tools/logs/log/reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tools/logs/log/big_endian.h"

namespace sprung::log {

namespace {

constexpr std::size_t kDamagesKept = 1000;
constexpr std::uint8_t kSync[kSyncBytes] = {0xED, 0xA1, 0xDA, 0x01};

[[noreturn]] void fail(const std::string& what, const std::string& path) {
  throw std::runtime_error("cannot " + what + " " + path + ": " + std::strerror(errno));
}

int open_file(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail("read", path);
  posix_fadvise(file, 0, 0, POSIX_FADV_SEQUENTIAL);
  return file;
}

std::uint64_t size_of(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace

struct Reader::Header {
  bool synchronous = false;
  std::int64_t number = 0;
  std::int64_t time_us = 0;
  std::uint32_t channel_bytes = 0;
  std::uint32_t data_bytes = 0;
  std::size_t event_bytes() const noexcept { return kHeaderBytes + channel_bytes + data_bytes; }
};

Reader::Reader(const std::string& path, const ReaderOptions& options)
    : path_(path), options_(options), file_(open_file(path)), file_bytes_(size_of(file_)) {
  buffer_.resize(std::max(options.buffer_bytes, 2 * kHeaderBytes));
}

Reader::~Reader() { close(file_); }

void Reader::rewind() {
  if (lseek(file_, 0, SEEK_SET) != 0) fail("go back in", path_);
  base_ = 0;
  begin_ = end_ = delivered_ = 0;
  at_end_ = damaged_ = false;
  damages_.clear();
  damage_count_ = skipped_bytes_ = 0;
}

bool Reader::next(Event& event) {
  begin_ += delivered_;
  delivered_ = 0;
  while (available(1)) {
    if (take(event)) {
      end_damage(DamageKind::kGarbage);
      return true;
    }
    begin_damage(DamageKind::kGarbage);
    skip_to_sync_word();
  }
  end_damage(damage_.kind);
  return false;
}

bool Reader::available(std::size_t bytes) {
  if (end_ - begin_ < bytes && !at_end_) refill(bytes);
  return end_ - begin_ >= bytes;
}

/// Moves what is left to the front and reads on until `bytes` are there, or the file ends.
void Reader::refill(std::size_t bytes) {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  base_ += begin_;
  end_ -= begin_;
  begin_ = 0;
  // Twice as much: else damage that claims long events again and again would have all of them moved for each
  // few bytes.
  if (buffer_.size() < 2 * bytes) buffer_.resize(2 * bytes);
  while (end_ < bytes && !at_end_) {
    const ssize_t got = read(file_, buffer_.data() + end_, buffer_.size() - end_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", path_);
    at_end_ = got == 0;
    end_ += static_cast<std::size_t>(got);
  }
}

Reader::Header Reader::header_at(std::size_t index) const noexcept {
  const std::uint8_t* const bytes = buffer_.data() + index;
  Header header;
  header.synchronous = get_big_endian<std::uint32_t>(bytes) == kSyncWord;
  header.number = static_cast<std::int64_t>(get_big_endian<std::uint64_t>(bytes + 4));
  header.time_us = static_cast<std::int64_t>(get_big_endian<std::uint64_t>(bytes + 12));
  header.channel_bytes = get_big_endian<std::uint32_t>(bytes + 20);
  header.data_bytes = get_big_endian<std::uint32_t>(bytes + 24);
  return header;
}

bool Reader::plausible(const Header& header) const noexcept {
  return header.synchronous && header.channel_bytes > 0 && header.channel_bytes <= kLongestChannel &&
         header.data_bytes <= options_.largest_event;
}

/// The event at begin_, if one is there.
bool Reader::take(Event& event) {
  if (!available(kHeaderBytes)) {
    const std::size_t left = std::min(end_ - begin_, kSyncBytes);
    if (std::memcmp(&buffer_[begin_], kSync, left) == 0) begin_damage(DamageKind::kCutOff);
    return false;
  }
  const Header header = header_at(begin_);
  if (!plausible(header)) return false;
  const std::size_t bytes = header.event_bytes();
  if (!available(bytes)) {
    begin_damage(DamageKind::kCutOff);
    return false;
  }
  available(bytes + kSyncBytes);
  if (!followed_well(bytes)) return false;
  deliver(header, event);
  return true;
}

void Reader::deliver(const Header& header, Event& event) noexcept {
  const std::uint8_t* const name = buffer_.data() + begin_ + kHeaderBytes;
  event.number = header.number;
  event.time_us = header.time_us;
  event.channel = {reinterpret_cast<const char*>(name), header.channel_bytes};
  event.data = name + header.channel_bytes;
  event.size = header.data_bytes;
  event.offset = position();
  delivered_ = header.event_bytes();
}

/// By a sync word, or by as much of one as the file still has.
bool Reader::followed_well(std::size_t event_bytes) const noexcept {
  const std::uint8_t* const next = buffer_.data() + begin_ + event_bytes;
  const std::size_t left = end_ - begin_ - event_bytes;
  if (left >= kSyncBytes) return get_big_endian<std::uint32_t>(next) == kSyncWord;
  return std::memcmp(next, kSync, left) == 0;
}

/// To the next sync word behind the byte at begin_, or to the end of the file.
void Reader::skip_to_sync_word() {
  ++begin_;
  while (available(kSyncBytes)) {
    const void* const at = memmem(buffer_.data() + begin_, end_ - begin_, kSync, kSyncBytes);
    if (at != nullptr) {
      begin_ = static_cast<std::size_t>(static_cast<const std::uint8_t*>(at) - buffer_.data());
      return;
    }
    begin_ = end_ - (kSyncBytes - 1);
  }
  begin_ = end_;
}

/// Here, unless one has begun already.
void Reader::begin_damage(DamageKind kind) noexcept {
  if (!damaged_) damage_ = {kind, position(), 0};
  damaged_ = true;
}

void Reader::end_damage(DamageKind kind) {
  if (!damaged_) return;
  damage_.kind = kind;
  damage_.bytes = position() - damage_.offset;
  if (damages_.size() < kDamagesKept) damages_.push_back(damage_);
  ++damage_count_;
  skipped_bytes_ += damage_.bytes;
  damaged_ = false;
}

}  // namespace sprung::log
