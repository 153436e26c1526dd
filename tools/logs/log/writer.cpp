#include "tools/logs/log/writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "tools/logs/log/big_endian.h"

namespace sprung::log {

namespace {

constexpr mode_t kReadableByAll = 0644;

[[noreturn]] void fail(const std::string& path) {
  const bool full = errno == ENOSPC || errno == EDQUOT;
  const std::string hint = full ? "; make room, or write to another disk" : "";
  throw WriteError("cannot write " + path + ": " + std::strerror(errno) + hint, full);
}

/// Of the whole file, for as long as this opening of it lasts: the kernel lets go when the process dies,
/// however it dies.
struct flock whole_file(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

/// Some file systems have no locks: a log there is written all the same.
void mark_as_written(int file) {
  struct flock lock = whole_file(F_WRLCK);
  (void)fcntl(file, F_OFD_SETLK, &lock);
}

}  // namespace

bool is_being_written(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  struct flock lock = whole_file(F_RDLCK);
  const bool asked = fcntl(file, F_OFD_GETLK, &lock) == 0;
  ::close(file);
  return asked && lock.l_type == F_WRLCK;
}

Writer::Writer(const std::string& path, std::size_t buffer_bytes)
    : path_(path),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll)),
      buffer_bytes_(buffer_bytes) {
  if (file_ < 0) fail(path);
  mark_as_written(file_);
  buffer_.reserve(buffer_bytes);
}

Writer::~Writer() {
  try {
    close();
  } catch (const WriteError&) {
    ::close(file_);
  }
}

void Writer::write(std::int64_t time_us, std::string_view channel, const void* data, std::size_t size) {
  if (channel.empty() || channel.size() > kLongestChannel)
    throw std::invalid_argument("an LCM log holds no channel '" + std::string(channel) + "'");
  if (size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("an LCM log holds no message of " + std::to_string(size) + " bytes");
  if (buffer_.size() >= buffer_bytes_) flush();
  std::uint8_t header[kHeaderBytes];
  put_big_endian(kSyncWord, header);
  put_big_endian(static_cast<std::uint64_t>(events_), header + 4);
  put_big_endian(static_cast<std::uint64_t>(time_us), header + 12);
  put_big_endian(static_cast<std::uint32_t>(channel.size()), header + 20);
  put_big_endian(static_cast<std::uint32_t>(size), header + 24);
  const auto* const bytes = static_cast<const std::uint8_t*>(data);
  buffer_.insert(buffer_.end(), header, header + kHeaderBytes);
  buffer_.insert(buffer_.end(), channel.begin(), channel.end());
  if (size > 0) buffer_.insert(buffer_.end(), bytes, bytes + size);
  ++events_;
}

void Writer::flush() {
  while (done_ < buffer_.size()) {
    const ssize_t sent = ::write(file_, buffer_.data() + done_, buffer_.size() - done_);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail(path_);
    done_ += static_cast<std::size_t>(sent);
    written_ += static_cast<std::uint64_t>(sent);
  }
  buffer_.clear();
  done_ = 0;
}

void Writer::sync() {
  flush();
  if (fdatasync(file_) != 0 && errno != EINVAL)
    fail(path_);  // EINVAL: a pipe or a device has no disk behind it
}

void Writer::close() {
  if (file_ < 0) return;
  flush();
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) fail(path_);
}

}  // namespace sprung::log
