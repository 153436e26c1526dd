#pragma once
/// Received messages on their way from the thread that receives to the one that writes. Unlimited, unless a
/// limit is given: a disk that is slow for a while loses nothing. lcm-logger's 30 messages over all channels
/// are why it loses some under load (facts L13). push() in one thread, take() in another.
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <vector>

namespace sprung {

class MessageQueue {
 public:
  /// Messages in order of arrival; one buffer holds the bytes of all.
  class Batch {
   public:
    std::size_t size() const noexcept { return items_.size(); }
    template <class Use>
    void for_each(Use&& use) const {
      for (const Item& item : items_) {
        const std::uint8_t* const bytes = bytes_.data() + item.offset;
        use(item.time_us, std::string_view(reinterpret_cast<const char*>(bytes), item.channel_bytes),
            bytes + item.channel_bytes, item.data_bytes);
      }
    }

   private:
    friend class MessageQueue;
    struct Item {
      std::int64_t time_us;
      std::size_t offset;
      std::size_t channel_bytes;
      std::size_t data_bytes;
    };
    std::vector<std::uint8_t> bytes_;
    std::vector<Item> items_;
  };

  MessageQueue() = default;
  /// @param most_bytes that wait at once; what comes while there are so many is left out, and counted. For
  /// who only looks.
  explicit MessageQueue(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  void push(std::int64_t time_us, std::string_view channel, const void* data, std::size_t size) {
    const auto* const begin = static_cast<const std::uint8_t*>(data);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (most_bytes_ > 0 && filling_.bytes_.size() + channel.size() + size > most_bytes_) {
      ++left_out_;
      return;
    }
    filling_.items_.push_back({time_us, filling_.bytes_.size(), channel.size(), size});
    filling_.bytes_.insert(filling_.bytes_.end(), channel.begin(), channel.end());
    filling_.bytes_.insert(filling_.bytes_.end(), begin, begin + size);
    longest_ = filling_.items_.size() > longest_ ? filling_.items_.size() : longest_;
  }

  /// Everything that waits, in exchange for a batch that was used up: its memory is used again.
  void take(Batch& batch) {
    batch.bytes_.clear();
    batch.items_.clear();
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(batch.bytes_, filling_.bytes_);
    std::swap(batch.items_, filling_.items_);
  }

  std::size_t longest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return longest_;
  }

  /// Messages that the limit kept out.
  std::int64_t left_out() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return left_out_;
  }

 private:
  const std::size_t most_bytes_ = 0;  ///< 0 = no limit
  mutable std::mutex mutex_;
  Batch filling_;
  std::size_t longest_ = 0;    ///< messages that waited at once
  std::int64_t left_out_ = 0;  ///< by the limit
};

}  // namespace sprung
