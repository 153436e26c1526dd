#pragma once
/// Reads an LCM log from its first byte to its last, in a small buffer however long the file is. Shell: reads
/// a file.
///
///   log::Reader reader("jump.lcm");
///   for (log::Event event; reader.next(event);) use(event.channel, event.data, event.size);
///   if (!reader.damages().empty()) complain(reader.skipped_bytes());
///
/// LCM's own reader ends at the first damage. This one goes on at the next sync word and says what it left
/// out. An event counts as whole when another one or the end of the file follows it at once: the event in
/// which a damage begins ends inside it, so that its data cannot be trusted.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/logs/log/event.h"

namespace sprung::log {

enum class DamageKind : std::int8_t {
  kGarbage,  ///< bytes that are no event, between two events or before the first
  kCutOff,   ///< the file ends inside an event
};

/// A stretch of the file that was left out.
struct Damage {
  DamageKind kind = DamageKind::kGarbage;
  std::uint64_t offset = 0;  ///< of its first byte
  std::uint64_t bytes = 0;
};

struct ReaderOptions {
  /// How much is read at once; grows to hold the largest event. This stays in a processor's own cache; a
  /// replay with 4 MB took more processor time.
  std::size_t buffer_bytes = std::size_t{128} << 10;
  std::size_t largest_event = std::size_t{64} << 20;  ///< data of an event; more counts as damage
};

class Reader {
 public:
  /// @throws std::runtime_error where the file cannot be opened, naming it. A file that is no log at all is
  /// all damage.
  explicit Reader(const std::string& path, const ReaderOptions& options = {});
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next event in the order of the file. @return false at the end. @throws std::runtime_error where the
  /// disk fails.
  bool next(Event& event);

  /// Back to the first event; what was found damaged is forgotten.
  void rewind();

  const std::string& path() const noexcept { return path_; }
  std::uint64_t file_bytes() const noexcept { return file_bytes_; }  ///< when it was opened
  std::uint64_t position() const noexcept {
    return base_ + begin_;
  }  ///< bytes done with, also where a damage is

  /// The first of them, complete once next() has returned false; see damage_count() for how many there are.
  const std::vector<Damage>& damages() const noexcept { return damages_; }
  std::uint64_t damage_count() const noexcept { return damage_count_; }
  std::uint64_t skipped_bytes() const noexcept { return skipped_bytes_; }

 private:
  struct Header;
  bool available(std::size_t bytes);
  void refill(std::size_t bytes);
  Header header_at(std::size_t index) const noexcept;
  bool plausible(const Header& header) const noexcept;
  bool take(Event& event);
  void deliver(const Header& header, Event& event) noexcept;
  bool followed_well(std::size_t event_bytes) const noexcept;
  void skip_to_sync_word();
  void begin_damage(DamageKind kind) noexcept;
  void end_damage(DamageKind kind);

  std::string path_;
  ReaderOptions options_;
  int file_ = -1;
  std::uint64_t file_bytes_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::uint64_t base_ = 0;     ///< offset in the file of buffer_[0]
  std::size_t begin_ = 0;      ///< first byte that is not done with
  std::size_t end_ = 0;        ///< past the last byte that was read
  std::size_t delivered_ = 0;  ///< bytes of the event that the caller is looking at
  bool at_end_ = false;        ///< the file has no more bytes than are in the buffer
  bool damaged_ = false;       ///< a damage began and has not ended
  Damage damage_;
  std::vector<Damage> damages_;
  std::uint64_t damage_count_ = 0;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace sprung::log
