#pragma once
/// All channels that were heard: type, figures, missing cycles, last message; and the history of the one that
/// is looked at. Pure.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::spy {

/// The last seconds of every number of one channel, for small plots.
class FieldHistory {
 public:
  static constexpr std::int64_t kInterval_us = 20'000;  ///< between samples, of what may come more often
  static constexpr std::size_t kSamples = 500;          ///< so the last 10 s

  /// Takes a sample if it is time. Begins anew when the message's layout is another one.
  void add(std::int64_t arrival_us, const fields::MessageView& message);
  void clear();
  /// Samples of the field of that index in the layout, oldest first; NaN of fields that are no numbers.
  std::vector<double> of(std::size_t field) const;

 private:
  std::shared_ptr<const fields::Layout> layout_;
  std::vector<double> samples_;  ///< ring of rows, one a message
  std::size_t rows_ = 0;         ///< in the ring
  std::size_t next_ = 0;
  std::int64_t last_us_ = 0;
};

/// How often a channel's messages come, how evenly, and how large they are. From times of arrival alone.
struct ChannelFigures {
  std::int64_t messages = 0;  ///< since it was first heard
  double rate_Hz = 0.0;       ///< of the last 2 s (of slower channels the last 5 messages); 0 = silent
  double jitter_us = 0.0;     ///< rms deviation of the intervals from their mean
  double longest_us = 0.0;    ///< longest interval among them
  double bytes_per_s = 0.0;
  std::size_t last_size = 0;  ///< bytes
  std::int64_t age_us = 0;    ///< since the last one
};

class ChannelStatistics {
 public:
  void add(std::int64_t arrival_us, std::size_t size);
  /// @param now_us on the clock of the arrivals.
  ChannelFigures figures(std::int64_t now_us) const;

 private:
  struct Arrival {
    std::int64_t time_us;
    std::size_t size;
  };
  std::deque<Arrival> recent_;
  std::int64_t messages_ = 0;
};

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
