#pragma once
/// LSS master (CiA 305): one request under way, with a time-out for its reply. Pure: the caller sends what
/// step() gives it, and calls with the time.
///
/// A device obeys in its configuration mode alone: select() or fastscan() puts one device into it,
/// switch_all() every device of the bus. What is configured counts after store() and the next reset; a device
/// that had no node id takes its new one when it is switched to waiting.
#include <array>
#include <cstdint>

#include "drivers/canopen/lss_frames.h"

namespace sprung::canopen {

enum class LssStatus : std::int8_t {
  kIdle,
  kBusy,
  kDone,
  kRefused,  ///< error() and maker_error() say why
  kTimeout,  ///< no answer: nobody was selected, or a device that answered a fastscan does so no more
  kNobody,   ///< fastscan: no device without a node id
};

class LssMaster {
 public:
  /// A device answers within milliseconds; a request without answer is not repeated, since nobody selected is
  /// the common reason [design choice].
  static constexpr std::int64_t kTimeout_us = 500'000;
  /// How long a fastscan listens for each of its 133 questions: silence means "no", and several devices may
  /// answer the same question one after the other [design choice].
  static constexpr std::int64_t kQuestion_us = 20'000;

  explicit LssMaster(std::int64_t timeout_us = kTimeout_us, std::int64_t question_us = kQuestion_us) noexcept
      : timeout_us_(timeout_us), question_us_(question_us) {}

  // Begin a request; whatever was under way is forgotten.
  /// Every device of the bus changes its mode; none answers.
  void switch_all(LssMode mode) noexcept;
  /// One device by its identity, into configuration mode.
  void select(const LssIdentity& identity) noexcept;
  /// @param part 0..3, as in LssIdentity; value() holds the number then.
  void inquire(int part) noexcept;
  void inquire_node() noexcept;  ///< value(): 1..127, kNoNode
  /// @param node 1..127, or kNoNode.
  void configure_node(int node) noexcept;
  /// @param index in the table of CiA 301: lss_bit_rate_index().
  void configure_bit_rate(int index) noexcept;
  /// All devices in configuration mode change their bit rate, after this pause; none answers.
  void activate_bit_rate(std::uint16_t delay_ms) noexcept;
  void store() noexcept;
  /// Finds one device that has no node id, and puts it into configuration mode; identity() names it. Again
  /// for the next one, until kNobody. 2.7 s by default.
  void fastscan() noexcept;

  /// @return true when `request` has to be sent now; call again to see whether there is more.
  bool step(std::int64_t time_us, CanFrame& request) noexcept;
  /// A frame of the bus; ignored unless it answers what was asked.
  void receive(const CanFrame& frame) noexcept;

  LssStatus status() const noexcept { return status_; }
  std::uint32_t value() const noexcept { return value_; }
  /// 1 = out of range or not supported, 2 = store: access to the memory failed, 255 = maker_error() says.
  int error() const noexcept { return static_cast<int>(value_ & 0xFF); }
  int maker_error() const noexcept { return static_cast<int>((value_ >> 8) & 0xFF); }
  const LssIdentity& identity() const noexcept { return identity_; }

 private:
  void begin(const CanFrame& request, LssCommand reply) noexcept;
  void begin_silent(const CanFrame& request) noexcept;
  void ask() noexcept;
  void answered(bool yes) noexcept;
  void next_bit(bool yes) noexcept;
  void next_part(bool yes) noexcept;

  std::int64_t timeout_us_, question_us_;
  LssStatus status_ = LssStatus::kIdle;
  std::array<CanFrame, 4> requests_{};  ///< to be sent in order; the last one has the reply
  std::size_t count_ = 0;
  std::size_t sent_ = 0;
  std::int64_t sent_us_ = 0;
  bool replies_ = false;      ///< the last request has a reply
  bool takes_error_ = false;  ///< the reply's value is an error code
  bool scanning_ = false;
  bool heard_ = false;
  LssCommand reply_ = LssCommand::kSelected;
  LssQuestion question_;
  std::uint32_t value_ = 0;
  LssIdentity identity_{};
};

}  // namespace sprung::canopen
