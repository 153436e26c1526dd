#pragma once
/// Writes an LCM log, byte for byte as LCM's own lcm_eventlog writes it. Shell: writes a file. The file is
/// locked while it is written, so that a reader can tell a log that still grows from one whose recorder was
/// killed.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/log/event.h"

namespace sprung::log {

/// A write that failed; its text names the file and the cause.
struct WriteError : std::runtime_error {
  WriteError(const std::string& text, bool full) : std::runtime_error(text), disk_full(full) {}
  bool disk_full;  ///< no room, or over a quota: what is still in the buffer is not lost, flush() may be
                   ///< tried again
};

class Writer {
 public:
  /// Makes the file, or empties it. @param buffer_bytes how much is gathered before the kernel gets it.
  /// @throws WriteError where it cannot be made.
  explicit Writer(const std::string& path, std::size_t buffer_bytes = std::size_t{1} << 20);
  /// Closes; errors are lost here, so call close() first.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Numbers the events itself, from 0. @param channel 1 to 999 bytes.
  /// @throws WriteError where a full buffer cannot be written (the event was not taken: call again, or give
  /// up), std::invalid_argument on a channel or a size that the format cannot hold.
  void write(std::int64_t time_us, std::string_view channel, const void* data, std::size_t size);
  /// The same event under a number of this file.
  void write(const Event& event) { write(event.time_us, event.channel, event.data, event.size); }

  void
  flush();  ///< hands everything to the kernel. @throws WriteError; what was not written stays in the buffer
  void sync();   ///< flush, then waits until it is on the disk. @throws WriteError
  void close();  ///< flush and close. @throws WriteError

  const std::string& path() const noexcept { return path_; }
  std::int64_t events() const noexcept { return events_; }                            ///< taken
  std::uint64_t bytes() const noexcept { return written_ + buffer_.size() - done_; }  ///< of the events taken

 private:
  std::string path_;
  int file_ = -1;
  std::size_t buffer_bytes_;
  std::vector<std::uint8_t> buffer_;
  std::size_t done_ = 0;  ///< bytes at the front of the buffer that are written
  std::uint64_t written_ = 0;
  std::int64_t events_ = 0;
};

/// Whether a Writer, of any process on this machine, has the file open. False of a file that cannot be
/// opened.
bool is_being_written(const std::string& path);

}  // namespace sprung::log
