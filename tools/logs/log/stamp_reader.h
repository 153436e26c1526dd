#pragma once
/// Session, time and cycle that every message of sprung begins with, read without decoding the rest. Pure.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "tools/logs/fields/type_table.h"

namespace sprung::log {

struct SessionStamp {
  std::int64_t session = 0;
  std::int64_t utime_us = 0;  ///< of the session; in lock-step the cycle's own time
  std::int64_t seq = -1;
};

class StampReader {
 public:
  explicit StampReader(const fields::TypeTable& types = fields::TypeTable::sprung()) : types_(types) {}

  /// Nothing where the type is unknown, or is one without a stamp.
  std::optional<SessionStamp> read(const std::uint8_t* data, std::size_t size);

 private:
  const fields::TypeTable& types_;
  std::unordered_map<std::int64_t, bool> stamped_;  ///< by fingerprint
};

}  // namespace sprung::log
