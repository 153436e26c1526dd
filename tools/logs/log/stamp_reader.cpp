#include "tools/logs/log/stamp_reader.h"

#include "runtime/message_layout.h"

namespace sprung::log {

namespace {

constexpr std::size_t kStampEnd = kSeqOffset + 8;
constexpr std::size_t kUtimeOffset = 16;

bool begins_with_stamp(const fields::StructType* type) {
  const char* const names[] = {"session", "utime", "seq"};
  if (type == nullptr || type->members.size() < std::size(names)) return false;
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const fields::Member& member = type->members[i];
    if (member.name != names[i] || member.wire != fields::Wire::kInt64 || !member.dimensions.empty())
      return false;
  }
  return true;
}

}  // namespace

std::optional<SessionStamp> StampReader::read(const std::uint8_t* data, std::size_t size) {
  if (size < kStampEnd) return std::nullopt;
  const std::int64_t hash = read_int64(data, 0);
  auto found = stamped_.find(hash);
  if (found == stamped_.end()) found = stamped_.emplace(hash, begins_with_stamp(types_.by_hash(hash))).first;
  if (!found->second) return std::nullopt;
  return SessionStamp{read_int64(data, kSessionOffset), read_int64(data, kUtimeOffset),
                      read_int64(data, kSeqOffset)};
}

}  // namespace sprung::log
