#pragma once
/// SDO client of one node: one expedited request in flight, time-out by the given time, one retry. Pure.
#include <cstdint>

#include "drivers/canopen/protocol.h"

namespace sprung::canopen {

enum class SdoStatus : std::int8_t {
  kIdle,  ///< nothing asked, or result taken
  kBusy,
  kDone,     ///< value() holds what was read
  kAborted,  ///< abort_code() says why
  kTimeout,  ///< no answer to the request nor to its retry
};

class SdoClient {
 public:
  /// @param timeout_us for each of the two attempts.
  SdoClient(int node, std::int64_t timeout_us) : node_(node), timeout_us_(timeout_us) {}

  /// Begin a request; whatever was under way is forgotten.
  void read(ObjectId object) noexcept;
  void write(ObjectId object, std::uint32_t value, int size) noexcept;
  /// @return true when `request` has to be sent now: the first time, and once more after a time-out.
  bool step(std::int64_t time_us, CanFrame& request) noexcept;
  /// A frame from this node's server; ignored when it answers nothing that was asked.
  void receive(const CanFrame& frame) noexcept;
  /// Forgets the result, so that the next request may begin.
  void finish() noexcept { status_ = SdoStatus::kIdle; }

  SdoStatus status() const noexcept { return status_; }
  bool idle() const noexcept { return status_ == SdoStatus::kIdle; }
  ObjectId object() const noexcept { return object_; }
  std::uint32_t value() const noexcept { return value_; }
  std::uint32_t abort_code() const noexcept { return value_; }

 private:
  void begin(const CanFrame& request, ObjectId object, SdoKind kind) noexcept;

  int node_;
  std::int64_t timeout_us_;
  SdoStatus status_ = SdoStatus::kIdle;
  SdoKind kind_ = SdoKind::kInvalid;
  ObjectId object_;
  CanFrame request_;
  std::uint32_t value_ = 0;
  std::int64_t sent_us_ = 0;
  int attempts_ = 0;
};

}  // namespace sprung::canopen
