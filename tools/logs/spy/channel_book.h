#pragma once
/// All channels that were heard: type, figures, missing cycles, last message; and the history of the one that
/// is looked at. Pure.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/recorder/gap_tracker.h"
#include "tools/logs/spy/channel_statistics.h"
#include "tools/logs/spy/field_history.h"

namespace sprung::spy {

struct Channel {
  ChannelStatistics statistics;
  GapTracker gaps;  ///< of channels that have every cycle
  bool has_every_cycle = false;
  std::string type;                            ///< "joint_state_t"; empty where nobody knows it
  std::optional<Stamp> stamp;                  ///< of the last message
  fields::Fault fault = fields::Fault::kNone;  ///< of the last message
  std::int64_t malformed = 0;                  ///< messages of a known type that were broken
  std::vector<std::uint8_t> last;              ///< bytes of the last message
};

class ChannelBook {
 public:
  /// @param types outlives this.
  explicit ChannelBook(const fields::TypeTable& types = fields::TypeTable::sprung()) : decoder_(types) {}

  void add(std::int64_t arrival_us, std::string_view name, const std::uint8_t* data, std::size_t size);

  const std::map<std::string, Channel, std::less<>>& channels() const noexcept { return channels_; }
  const Channel* find(std::string_view name) const noexcept;
  /// Decodes the channel's last message. @return false where there is none, or it cannot be decoded.
  bool open_last(const Channel& channel, fields::MessageView& message);

  /// Keeps the history of this channel, and no more of another; empty = of none.
  void follow(const std::string& name);
  const FieldHistory& history() const noexcept { return history_; }

 private:
  fields::Decoder decoder_;
  fields::MessageView view_;
  std::map<std::string, Channel, std::less<>> channels_;
  std::string followed_;
  FieldHistory history_;
};

}  // namespace sprung::spy
